# SPDX-License-Identifier: Apache-2.0
"""
Confidence intervals of what was measured in generations of processes.

Two runs of one program differ by more than the effect that is measured, because their memory lies in different places.
Messages of one generation are therefore no independent samples. The bootstrap is hierarchical: it draws generations, and
within each of them the blocks of measurements.
"""

import math
import random
from dataclasses import dataclass

DRAWS = 1000
CONFIDENCE = 0.95

# Student's t at 97.5 %, by degrees of freedom.
_T = (12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201, 2.179, 2.160, 2.145, 2.131, 2.120,
      2.110, 2.101, 2.093, 2.086, 2.080, 2.074, 2.069, 2.064, 2.060, 2.056, 2.052, 2.048, 2.045, 2.042)
_NORMAL = 1.960


@dataclass(frozen=True)
class Estimate:
    """A value with the interval in which it lies with a confidence of 95 %."""

    value: float
    low: float
    high: float

    def scaled(self, factor):
        ends = sorted((self.low * factor, self.high * factor))
        return Estimate(self.value * factor, *ends)

    def as_json(self, digits=4):
        return {'value': round(self.value, digits), 'low': round(self.low, digits), 'high': round(self.high, digits)}


def widening(groups):
    """
    By how much the interval of a bootstrap over so few groups is too narrow.

    Its draws have the variance (n - 1) / n of that of the mean, and the normal distribution where Student's belongs.
    """
    if groups < 2:
        return math.inf
    t = _T[groups - 2] if groups - 2 < len(_T) else _NORMAL
    return math.sqrt(groups / (groups - 1)) * t / _NORMAL


def hierarchical(groups, statistic, seed=0, draws=DRAWS):
    """
    Estimates `statistic` with its interval.

    `groups` is a list of generations. A generation is a list of strata, such as the combinations of rate and size; a
    stratum is a list of blocks. Every generation has the same strata. `statistic` gets a list of strata, each the list of
    its blocks in all drawn generations.
    """
    strata = range(len(groups[0]))
    value = statistic([[block for group in groups for block in group[stratum]] for stratum in strata])
    chance = random.Random(seed)
    results = []
    for _ in range(draws):
        drawn = chance.choices(groups, k=len(groups))
        results.append(statistic([[block for group in drawn for block in chance.choices(group[stratum],
                                                                                       k=len(group[stratum]))]
                                  for stratum in strata]))
    results.sort()
    wider = widening(len(groups))
    if math.isinf(wider):
        # One group tells nothing about others; the blocks are all there is.
        wider = 1.0
    below = results[int((1 - CONFIDENCE) / 2 * (draws - 1))]
    above = results[math.ceil((1 + CONFIDENCE) / 2 * (draws - 1))]
    return Estimate(value, min(value, value - wider * (value - below)), max(value, value + wider * (above - value)))


def of_samples(samples, statistic=None, seed=0):
    """The interval of the median (or another statistic) of independent samples, such as runs of a program."""
    statistic = statistic or median
    return hierarchical([[[sample]] for sample in samples], lambda strata: statistic(strata[0]), seed)


def median(values):
    ordered = sorted(values)
    middle = len(ordered) // 2
    return ordered[middle] if len(ordered) % 2 else (ordered[middle - 1] + ordered[middle]) / 2


def middle_mean(values):
    """The mean of the middle half: a disturbed block has no effect, and more than one block counts."""
    ordered = sorted(values)
    cut = len(ordered) // 4
    return mean(ordered[cut:len(ordered) - cut])


def mean(values):
    return sum(values) / len(values)
