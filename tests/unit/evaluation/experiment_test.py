# SPDX-License-Identifier: Apache-2.0
"""What the experiment makes of latencies, on made ones: tracing adds 3 µs to each message."""

import random
import unittest

from evaluation.experiment import (Combination, Samples, aggregate_json, block_of, combination_json, combinations_of,
                                   mean_overhead, median_overhead)
from evaluation.presets import PRESETS

ADDED_NS = 3000


def made_samples(seed, base_ns, generations=5, messages=400):
    chance = random.Random(seed)
    samples = Samples()
    for _ in range(generations):
        samples.generations.append([])
        place = chance.gauss(base_ns, base_ns / 10)  # generations differ by more than tracing adds
        for _ in range(2):
            untraced = [round(chance.gauss(place, 500)) for _ in range(messages)]
            traced = [round(chance.gauss(place + ADDED_NS, 500)) for _ in range(messages)]
            samples.add(untraced, traced, messages)
    return samples


class Overhead(unittest.TestCase):

    def test_of_a_block_is_the_difference(self):
        block = block_of([1000, 2000, 3000], [2000, 4000, 9000])
        self.assertEqual(mean_overhead([block]), 3.0)
        self.assertEqual(median_overhead([block]), 2.0)

    def test_of_a_combination_is_found_although_generations_differ(self):
        result = combination_json(Combination(2, 1024, 100), made_samples(1, 50_000))
        for which in ('overhead_of_mean', 'overhead_of_median'):
            overhead = result[which]['us']
            self.assertLess(overhead['low'], 3.0 + 0.1)
            self.assertGreater(overhead['high'], 3.0 - 0.1)
            self.assertLess(overhead['high'] - overhead['low'], 0.5)
        self.assertAlmostEqual(result['overhead_of_mean']['part']['value'], 3 / 50, delta=0.02)
        self.assertEqual(result['missed'], 0)

    def test_of_all_combinations_is_found_as_well(self):
        samples = {Combination(2, size, 100): made_samples(size, base)
                   for size, base in ((1024, 40_000), (65536, 90_000), (262144, 300_000))}
        result = aggregate_json(samples)
        for which in ('overhead_merged', 'overhead_of_means', 'overhead_of_medians'):
            self.assertAlmostEqual(result[which]['value'], 3, delta=0.2)
            self.assertLessEqual(result[which]['low'], result[which]['value'])
        self.assertAlmostEqual(result['untraced']['mean'], 0, delta=0.01)
        self.assertAlmostEqual(result['traced']['mean'], 3, delta=0.2)

    def test_merged_weighs_by_messages(self):
        few, many = made_samples(1, 50_000, messages=10), Samples()
        for _ in range(5):
            many.generations.append([block_of([1000] * 90, [2000] * 90)] * 2)
        many.untraced.add([1000] * 900)
        many.traced.add([2000] * 900)
        result = aggregate_json({Combination(2, 1024, 100): few, Combination(2, 1024, 1000): many})
        self.assertAlmostEqual(result['overhead_merged']['value'], (1 * 90 + 3 * 10) / 100, delta=0.1)
        self.assertAlmostEqual(result['overhead_of_means']['value'], 2, delta=0.3)

    def test_tells_messages_that_did_not_come(self):
        samples = made_samples(1, 50_000)
        samples.generations.append([])
        samples.add([50_000] * 8, [53_000] * 9, 10)
        self.assertEqual(combination_json(Combination(1, 1024, 100), samples)['missed'], 3)


class Combinations(unittest.TestCase):

    def test_are_the_sixteen_of_the_paper(self):
        for preset in ('quick', 'full'):
            self.assertEqual(len(combinations_of(PRESETS[preset], 2)), 16)

    def test_full_measures_an_hour_of_each_traced_and_untraced(self):
        full = PRESETS['full']
        self.assertEqual(2 * full.generations * full.blocks * full.batch_seconds, 3600)


if __name__ == '__main__':
    unittest.main()
