# SPDX-License-Identifier: Apache-2.0
"""Comparisons of two results."""

import random
import unittest

from evaluation.bootstrap import of_samples
from evaluation.compare import compare
from evaluation.results import Figure, figure_of

MACHINE = {'processor': 'a processor', 'processors': 2, 'kernel': '6'}


def result_of(figures, **more):
    return {'preset': 'quick', 'machine': MACHINE, 'warnings': [], 'figures': [one.as_json() for one in figures], **more}


def figure(name, values, better='lower', **more):
    return figure_of('start', name, 'ms', of_samples(values), len(values), better=better, **more)


class Comparison(unittest.TestCase):

    def text_of(self, before, after, **more):
        return compare(result_of([before]), result_of([after], **more)).text()

    def test_names_what_is_worse(self):
        text = self.text_of(figure('a', [10.0, 10.1, 9.9, 10.0, 10.0]), figure('a', [12.0, 12.1, 11.9, 12.0, 12.0]))
        self.assertRegex(text, r'^worse   start: a: 10 -> 12 ms \(20 %\), noise up to [0-9.]+\n'
                               r'1 figure compared, 1 changed beyond noise\n$')

    def test_knows_which_direction_is_better(self):
        comparison = compare(result_of([figure('a', [10.0] * 5, better='higher')]),
                             result_of([figure('a', [12.0] * 5, better='higher')]))
        self.assertEqual([one.verdict for one in comparison.beyond_noise], ['better'])
        self.assertEqual(comparison.worse, [])

    def test_leaves_out_noise(self):
        self.assertEqual(self.text_of(figure('a', [10.0, 14.0, 9.0, 12.0, 11.0]), figure('a', [12.0, 9.0, 13.0, 14.0, 11.0])),
                         '1 figure compared, none changed beyond noise\n')

    def test_leaves_out_small_changes_however_sure(self):
        self.assertEqual(self.text_of(figure('a', [10.0] * 5), figure('a', [10.2] * 5)),
                         '1 figure compared, none changed beyond noise\n')

    def test_takes_the_speed_of_the_machine_out_by_the_floor(self):
        slow_machine = figure('a', [20.0] * 5, floor=of_samples([10.0] * 5), floor_name='bare')
        self.assertEqual(self.text_of(figure('a', [10.0] * 5, floor=of_samples([5.0] * 5), floor_name='bare'), slow_machine),
                         '1 figure compared, none changed beyond noise\n')

    def test_counts_the_noise_of_the_floor(self):
        before, after = (figure('a', [10.0] * 5, floor=of_samples(samples), floor_name='bare')
                         for samples in ([5.0, 7.0, 4.0, 6.0, 5.0], [5.0, 8.0, 6.0, 7.0, 6.0]))
        self.assertEqual(self.text_of(before, after), '1 figure compared, none changed beyond noise\n')

    def test_tells_what_only_one_side_has_and_that_the_machines_differ(self):
        text = self.text_of(figure('a', [1.0] * 5), figure('b', [1.0] * 5), machine={**MACHINE, 'kernel': '7'})
        self.assertEqual(text, 'note    the machines differ: kernel 6 and 7\ngone    start: a\nnew     start: b\n'
                               '0 figures compared, none changed beyond noise\n')

    def test_finds_no_change_between_runs_of_one_system(self):
        chance = random.Random(5)
        alarms = 0
        for _ in range(100):
            # Means whose intervals are as wide as their deviation says.
            sides = [result_of([Figure('start', str(name), 'ms', value, value - 19.6, value + 19.6, 7)
                                for name, value in enumerate(chance.gauss(100, 10) for _ in range(30))])
                     for _ in range(2)]
            alarms += bool(compare(*sides).beyond_noise)
        self.assertLessEqual(alarms, 4)  # of 100 comparisons with 30 figures each


if __name__ == '__main__':
    unittest.main()
