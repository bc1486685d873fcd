# SPDX-License-Identifier: Apache-2.0
"""Distributions of latencies."""

import random
import unittest

from evaluation.distribution import BIN_NS, Distribution


class Quantiles(unittest.TestCase):

    def test_are_those_of_the_samples(self):
        chance = random.Random(7)
        latencies = [round(chance.lognormvariate(10, 0.5)) for _ in range(5001)]
        distribution = Distribution(latencies)
        latencies.sort()
        for part in (0.01, 0.25, 0.5, 0.75, 0.99):
            self.assertAlmostEqual(distribution.quantile(part), latencies[round(part * 5000)], delta=BIN_NS)
        self.assertEqual(distribution.mean, sum(latencies) / 5001)
        self.assertEqual((distribution.least, distribution.most), (latencies[0], latencies[-1]))

    def test_do_not_leave_the_range_of_the_samples(self):
        distribution = Distribution([1234])
        self.assertEqual(distribution.quantile(0), 1234)
        self.assertEqual(distribution.quantile(1), 1234)

    def test_are_those_of_all_that_was_added(self):
        parts = Distribution([100, 300])
        parts.add([200])
        self.assertAlmostEqual(parts.quantile(0.5), 200, delta=BIN_NS)
        self.assertEqual(parts.count, 3)


class Shift(unittest.TestCase):

    def test_moves_everything(self):
        shifted = Distribution()
        shifted.add_shifted(Distribution([1000, 2000, 6000]), -3000)
        self.assertEqual(shifted.mean, 0)
        self.assertEqual((shifted.least, shifted.most), (-2000, 3000))
        self.assertAlmostEqual(shifted.quantile(0.5), -1000, delta=BIN_NS)

    def test_of_nothing_changes_nothing(self):
        shifted = Distribution([5])
        shifted.add_shifted(Distribution(), 100)
        self.assertEqual(shifted.count, 1)


class Outliers(unittest.TestCase):

    def test_are_counted_and_kept(self):
        latencies = [1000 + i for i in range(1000)] + [1_000_000, 2_000_000]
        distribution = Distribution(latencies)
        number, mean_of_the_rest = distribution.outliers()
        self.assertEqual(number, 2)
        self.assertAlmostEqual(mean_of_the_rest, 1499.5, delta=BIN_NS)
        self.assertEqual(distribution.mean, sum(latencies) / 1002)
        summary = distribution.summary()
        self.assertEqual((summary['messages'], summary['outliers'], summary['most']), (1002, 2, 2000.0))

    def test_are_none_in_an_even_distribution(self):
        self.assertEqual(Distribution(range(1000)).outliers()[0], 0)


if __name__ == '__main__':
    unittest.main()
