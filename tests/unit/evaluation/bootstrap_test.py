# SPDX-License-Identifier: Apache-2.0
"""Confidence intervals, on made data whose truth is known."""

import random
import unittest

from evaluation.bootstrap import hierarchical, mean, median, middle_mean, of_samples, widening

TRUTH = 5.0


def made_experiment(chance, generations=5, blocks=4, between=1.0, within=2.0):
    """Generations that differ by more than their blocks do."""
    groups = []
    for _ in range(generations):
        level = chance.gauss(TRUTH, between)
        groups.append([[chance.gauss(level, within) for _ in range(blocks)]])
    return groups


def coverage(between, within, experiments=150):
    """The part of the experiments whose interval holds the truth."""
    chance = random.Random(11)
    held = 0
    for experiment in range(experiments):
        estimate = hierarchical(made_experiment(chance, between=between, within=within), lambda strata: mean(strata[0]),
                                seed=experiment, draws=200)
        held += estimate.low <= TRUTH <= estimate.high
    return held / experiments


class Coverage(unittest.TestCase):

    def test_holds_the_truth_when_generations_differ(self):
        self.assertGreaterEqual(coverage(between=2.0, within=0.5), 0.9)

    def test_holds_the_truth_when_blocks_differ(self):
        self.assertGreaterEqual(coverage(between=0.0, within=2.0), 0.9)

    def test_is_no_longer_that_of_the_blocks_alone(self):
        # An interval that took blocks for independent would be about a fourth as wide.
        estimate = hierarchical(made_experiment(random.Random(3), blocks=50, between=2.0, within=0.1),
                                lambda strata: mean(strata[0]))
        self.assertGreater(estimate.high - estimate.low, 1.0)


class Estimates(unittest.TestCase):

    def test_are_the_statistic_of_everything(self):
        estimate = hierarchical([[[1, 2]], [[3]], [[6]]], lambda strata: mean(strata[0]))
        self.assertEqual(estimate.value, 3)
        self.assertLess(estimate.low, 3)
        self.assertGreater(estimate.high, 3)

    def test_keep_strata_apart(self):
        # The first stratum is always ten times the second one.
        groups = [[[10 * level], [level]] for level in (1, 2, 3)]
        ratio = hierarchical(groups, lambda strata: mean(strata[0]) / mean(strata[1]))
        for value in (ratio.value, ratio.low, ratio.high):
            self.assertAlmostEqual(value, 10)

    def test_of_equal_samples_have_no_width(self):
        estimate = of_samples([4, 4, 4])
        self.assertEqual((estimate.value, estimate.low, estimate.high), (4, 4, 4))

    def test_are_the_same_each_time(self):
        groups = made_experiment(random.Random(1))
        once, again = (hierarchical(groups, lambda strata: median(strata[0])) for _ in range(2))
        self.assertEqual(once, again)

    def test_change_sides_when_scaled_by_a_negative_factor(self):
        scaled = of_samples([1, 2, 3]).scaled(-1)
        self.assertLess(scaled.low, scaled.value)
        self.assertLess(scaled.value, scaled.high)


class Widening(unittest.TestCase):

    def test_falls_with_the_number_of_generations(self):
        factors = [widening(groups) for groups in (2, 3, 5, 10, 30, 1000)]
        self.assertEqual(factors, sorted(factors, reverse=True))
        self.assertAlmostEqual(factors[-1], 1, delta=0.01)


class Median(unittest.TestCase):

    def test_of_odd_and_even_numbers_of_samples(self):
        self.assertEqual(median([3, 1, 2]), 2)
        self.assertEqual(median([4, 1, 2, 3]), 2.5)

    def test_of_the_middle_half_leaves_out_what_is_far_away(self):
        self.assertEqual(middle_mean([1000, 1, 2, 3, 4, -500, 2.5, 2.5]), 2.5)
        self.assertEqual(middle_mean([7]), 7)


if __name__ == '__main__':
    unittest.main()
