# SPDX-License-Identifier: Apache-2.0
"""The page and the Markdown of a made result."""

import functools
import os
import random
import re
import unittest
from html.parser import HTMLParser
from pathlib import Path
from xml.etree import ElementTree

from evaluation import curves, drawing, markdown, page, pictures, tables
from evaluation.experiment import Combination, Samples, aggregate_json, combination_json
from evaluation.measures import (calls, discovery, entities, hosts, layers, local, losses, reading, sessions, stack, start,
                                 tracepoints)
from evaluation.results import Figure

SOURCE = Path(os.environ['SOURCE_DIRECTORY'])


def made_combinations(processes):
    chance = random.Random(processes)
    made = {}
    for size in (1024, 262144):
        for rate in (100, 2000):
            samples = made[Combination(processes, size, rate)] = Samples()
            for _ in range(3):
                samples.generations.append([])
                for _ in range(2):
                    samples.add([round(chance.gauss(50_000, 3000)) for _ in range(50)],
                                [round(chance.gauss(51_000, 3000)) for _ in range(50)], 50)
    return made


@functools.cache
def made_result():
    sides = {processes: made_combinations(processes) for processes in (2, 1)}
    return {
        'written': '2026-01-02T03:04:05+00:00', 'preset': 'quick', 'only': [], 'took_s': 12.3,
        'machine': {'processor': 'A <fast> one', 'processors': 2, 'usable_processors': 2, 'mhz': 1000.0, 'cache': '1 KB',
                    'memory_mib': 1024, 'virtual': False, 'kernel': '6.1', 'kernel_version': '#1', 'real_time_kernel': False,
                    'clock_source': 'tsc', 'load_before': [0.1, 0, 0], 'load_after': [0.2, 0, 0], 'stolen': 0.0},
        'settings': [{'name': 'turbo', 'state': 'absent', 'detail': 'none'}],
        'warnings': ['The machine was busy.'],
        'failures': [{'step': 'start', 'reason': 'no program'}],
        'left_out': [{'what': 'kernel', 'reason': 'no modules'}],
        'figures': [Figure('start', 'one process', 'ms', 12.0, 11.0, 13.5, 5, floor=3.0, floor_name='posix_spawn').as_json()],
        'experiment': {
            'session': {'name': 'paper', 'events': ['ros2:*'], 'contexts': [], 'buffers': 'pid', 'subbuffer_size': '2M',
                        'subbuffers': 2, 'read_timer_us': 200000},
            'generations': 3, 'blocks': 1, 'batch_seconds': 0.1, 'seed': 1, 'lost_events': 0, 'trace_bytes': 1000,
            'combinations': [combination_json(*one) for side in sides.values() for one in side.items()],
            'aggregates': {str(processes): aggregate_json(side) for processes, side in sides.items()},
        },
    }


class Checker(HTMLParser):
    """Notes elements that are not closed in their order, and addresses of other places."""

    void = ('meta', 'path', 'rect', 'circle')

    def __init__(self):
        super().__init__()
        self.open, self.wrong, self.outside = [], [], []

    def handle_starttag(self, tag, attributes):
        self.outside += [value for name, value in attributes if name in ('src', 'href')]
        if tag not in self.void:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        pass

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.wrong.append(tag)


class Page(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.result = made_result()
        cls.page = page.html(cls.result)

    def test_is_well_formed_and_refers_to_nothing_outside(self):
        checker = Checker()
        checker.feed(self.page)
        self.assertEqual((checker.open, checker.wrong, checker.outside), ([], [], []))
        self.assertNotIn('<script', self.page)

    def test_has_the_papers_figures_for_one_and_two_processes(self):
        for title in ('Latencies, two processes (as figure 7 of the paper)', 'Latencies, one process (as figure 7 of the paper)',
                      'Added to the mean, two processes (as figure 8 of the paper)',
                      'All combinations together (as figure 9 of the paper)'):
            self.assertIn(f'<h2>{title}</h2>', self.page)
        self.assertEqual(self.page.count('<svg'), 2 * (2 + 2 + 2) + 1)

    def test_says_what_must_be_known_first(self):
        self.assertIn('<li>The machine was busy.</li><li>start was not measured: no program</li>'
                      '<li>Not possible here: kernel: no modules</li>', self.page)

    def test_escapes_what_others_have_named(self):
        self.assertIn('A &lt;fast&gt; one', self.page)
        self.assertNotIn('<fast>', self.page)

    def test_pictures_stay_within_their_frame(self):
        charts = pictures.latencies(self.result['experiment'], 2)[0] + pictures.overheads(self.result['experiment'], 1)[0]
        for svg in charts + [pictures.aggregate(self.result['experiment'])]:
            for circle in ElementTree.fromstring(svg).iter('circle'):
                self.assertLess(drawing.LEFT, float(circle.get('cx')))
                self.assertLess(float(circle.get('cx')), drawing.WIDTH)
                self.assertLess(0, float(circle.get('cy')))
                self.assertLess(float(circle.get('cy')), drawing.HEIGHT - drawing.BOTTOM + 1)


class Curves(unittest.TestCase):

    def test_of_losses_have_a_line_for_each_size_of_buffers(self):
        figures = [Figure('losses', f'{rate} events/s, {buffers}, lost', '%', 10.0, 5.0, 15.0, 3).as_json()
                   for rate in (1000, 2000) for buffers in ('2 x 32 KiB', '4 x 1024 KiB')]
        picture = curves.losses(figures)
        self.assertEqual(picture.count('<circle'), 4)
        self.assertIn('2 x 32 KiB</span>', picture)
        self.assertIn('<title>2,000: 10 % (5 to 15)</title>', picture)

    def test_of_processes_have_their_floor_beside_them(self):
        figures = [Figure('start and stop of processes', f'{count} process{"es" if count > 1 else ""} {what}', 'ms', 10.0 * count,
                          -1.0, 11.0 * count, 3, floor=2.0 * count, floor_name='a loop').as_json()
                   for count in (1, 10, 100) for what in ('started', 'stopped')]
        picture = curves.processes(figures)
        self.assertEqual((picture.count('<svg'), picture.count('<circle')), (2, 12))
        self.assertIn('<title>100: 200 ms, a loop</title>', picture)

    def test_need_two_points(self):
        self.assertEqual(curves.losses([]), '')
        self.assertEqual(curves.entities([]), '')
        self.assertEqual(curves.processes([Figure('start', '1 process started', 'ms', 1.0, 1.0, 1.0, 2).as_json()]), '')

    def test_of_executors_have_a_line_for_each_rclcpp(self):
        figures = [Figure('executors', f'{which}a message beside {count} subscription{"s" if count > 1 else ""}', 'us', 4.0, 3.0,
                          5.0, 3).as_json() for which in ('', 'rclcpp of /opt/ros/other: ') for count in (1, 10, 100)]
        picture = curves.entities(figures)
        self.assertEqual(picture.count('stroke thick'), 2)
        self.assertIn('<i></i>this stack</span>', picture)
        self.assertIn('<i></i>rclcpp of /opt/ros/other</span>', picture)

    def test_belong_to_groups_that_are_measured(self):
        self.assertEqual(set(curves.PICTURES), {entities.GROUP, losses.GROUP, start.GROUP})


class Tables(unittest.TestCase):

    def test_put_a_figure_beside_its_floor(self):
        head, rows = tables.figures(made_result()['figures'])
        self.assertEqual(rows, [['one process', '12 (11 to 13.5)', 'ms', '3: posix_spawn', '4', '5']])
        self.assertEqual(len(head), len(rows[0]))

    def test_give_the_spread_of_a_floor_and_of_the_ratio(self):
        one = Figure('start', 'a', 'ms', 20.0, 14.0, 26.0, 5, floor=10.0, floor_low=6.0, floor_high=14.0, floor_name='bare')
        _, rows = tables.figures([one.as_json()])
        self.assertEqual(rows, [['a', '20 (14 to 26)', 'ms', '10 (6 to 14): bare', '2 (1 to 3)', '5']])

    def test_put_no_figure_beside_itself(self):
        _, rows = tables.figures([Figure('reading', 'dummy', 'us', 2.0, 1.0, 3.0, 5, floor=2.0, floor_name='dummy').as_json()])
        self.assertEqual(rows, [['dummy', '2 (1 to 3)', 'µs', '', '', '5']])

    def test_have_the_figures_of_the_paper(self):
        head, rows = tables.beside_the_paper(made_result()['experiment'])
        self.assertEqual(head, ['', 'the paper, two processes', 'here, two processes', 'here, one process'])
        self.assertEqual([row[1] for row in rows], ['3.3', '–', '–', '1 to 5.6', '1 % to 15 %', '–'])
        for row in rows:
            self.assertEqual(len(row), len(head))


class Markdown(unittest.TestCase):

    def test_has_all_tables(self):
        text = markdown.tables_of(made_result())
        for line in ('**The machine was busy.**', 'start was not measured: no program.', 'Not possible here: kernel: no modules.', '### Every combination, one process',
                     '### Start', '| one process | 12 (11 to 13.5) | ms | 3: posix_spawn | 4 | 5 |'):
            self.assertIn(line + '\n', text)

    def test_replaces_what_stands_between_the_marks(self):
        old = f'before\n{markdown.BEGIN}\noutdated\n{markdown.END}\nafter\n'
        once = markdown.put_into(old, made_result())
        self.assertTrue(once.startswith(f'before\n{markdown.BEGIN}\n\nPreset quick'))
        self.assertTrue(once.endswith(f'{markdown.END}\nafter\n'))
        self.assertNotIn('outdated', once)
        self.assertEqual(markdown.put_into(once, made_result()), once)

    def test_puts_chosen_groups_into_a_page(self):
        page_text = '<!-- results: start; stop -->\n<!-- end of results -->\n'
        self.assertEqual(markdown.put_into(page_text, made_result()), (
            '<!-- results: start; stop -->\n\nPreset quick, 2026-01-02, 2 processors (A <fast> one).\n\n'
            '**The machine was busy.**\n\n'
            '|  | measured | unit | floor | ratio | samples |\n| --- | --- | --- | --- | --- | --- |\n'
            '| one process | 12 (11 to 13.5) | ms | 3: posix_spawn | 4 | 5 |\n\nstop: not measured.\n\n'
            '<!-- end of results -->\n'))

    def test_puts_an_earlier_run_beside_this_one(self):
        text = markdown.tables_of(made_result(), made_result())
        section = text[text.index('### Beside an earlier run'):]
        rows = re.findall(r'^\| two processes, mean overhead \| (.*) \| (.*) \| yes \|$', section, re.M)
        self.assertEqual(len(rows), 1)
        self.assertEqual(rows[0][0], rows[0][1])
        counts = re.search(r'Of the (\d+) intervals of the experiment, .*, (\d+) overlap', section)
        self.assertEqual(counts[1], counts[2])
        self.assertTrue(section.endswith('figures compared, none changed beyond noise\n```\n'), section[-200:])
        self.assertNotIn('earlier', markdown.tables_of(made_result()))

    def test_needs_the_marks(self):
        self.assertIsNone(markdown.put_into('nothing', made_result()))


class Documentation(unittest.TestCase):

    def test_marks_name_groups_that_are_measured(self):
        measured = {module.GROUP for module in (calls, discovery, entities, hosts, layers, local, losses, reading, sessions, stack,
                                                start, tracepoints)}
        marks = 0
        for name in ('evaluation', 'scale'):
            for groups in re.findall('<!-- results: (.*) -->', (SOURCE / f'docs/{name}.md').read_text()):
                marks += 1
                if groups != 'all':
                    self.assertLessEqual(set(groups.split('; ')), measured)
        self.assertEqual(marks, 7)


class Numbers(unittest.TestCase):

    def test_have_three_digits(self):
        self.assertEqual([drawing.number(value) for value in (0, 0.01234, 1.5, -2.25, 123.4, 98765.4)],
                         ['0', '0.0123', '1.5', '−2.25', '123', '98,765'])

    def test_of_an_axis_are_round_and_cover_the_range(self):
        self.assertEqual(drawing.linear_ticks(0, 9.3), [0, 2, 4, 6, 8, 10])
        self.assertEqual(drawing.log_ticks(12, 900), [10, 100, 1000])


if __name__ == '__main__':
    unittest.main()
