# SPDX-License-Identifier: Apache-2.0
"""
Which figures have changed between two results, beyond noise.

A figure has changed if zero lies outside the interval of its difference. Many figures are compared at once, so the intervals
are those with which none of the changes is there by chance, with a confidence of 99 %. Where both results have the floor of
a figure, the ratios to the floors are compared, because a floor is as fast or slow as its machine. Changes below 5 % do not
count.
"""

import math
from dataclasses import dataclass
from statistics import NormalDist

from .drawing import number
from .results import figures_of

CONFIDENCE = 0.99
LEAST_PART = 0.05
_NORMAL = 1.960  # what an interval of 95 % is of the standard deviation


@dataclass(frozen=True)
class Change:
    """A figure before and after."""

    name: str
    unit: str
    before: float
    after: float
    bound: float  # a difference up to this may be there by chance
    better: str

    @property
    def difference(self):
        return self.after - self.before

    @property
    def beyond_noise(self):
        return abs(self.difference) > max(self.bound, LEAST_PART * abs(self.before))

    @property
    def verdict(self):
        if self.better == 'neither':
            return 'changed'
        return 'worse' if (self.difference > 0) == (self.better == 'lower') else 'better'

    def line(self):
        part = f' ({number(100 * self.difference / abs(self.before))} %)' if self.before else ''
        return (f'{self.verdict:<8}{self.name}: {number(self.before)} -> {number(self.after)} {self.unit}{part}, '
                f'noise up to {number(self.bound)}')


@dataclass(frozen=True)
class Comparison:
    """All figures that both results have, and the names of the others."""

    changes: list
    gone: list
    new: list
    remarks: list

    @property
    def beyond_noise(self):
        return [change for change in self.changes if change.beyond_noise]

    @property
    def worse(self):
        return [change for change in self.beyond_noise if change.verdict == 'worse']

    def text(self):
        order = {'worse': 0, 'better': 1, 'changed': 2}
        lines = [f'note    {remark}' for remark in self.remarks]
        lines += [change.line() for change in sorted(self.beyond_noise, key=lambda one: order[one.verdict])]
        lines += [f'gone    {name}' for name in self.gone] + [f'new     {name}' for name in self.new]
        counted = f'{len(self.changes)} figure{"" if len(self.changes) == 1 else "s"} compared'
        changed = len(self.beyond_noise)
        return '\n'.join(lines + [f'{counted}, {changed or "none"} changed beyond noise']) + '\n'


def _deviation(figure):
    return (figure.high - figure.low) / 2 / _NORMAL


def _change(name, before, after, z):
    sides, unit = (before, after), before.unit
    if before.floor and after.floor:
        sides, unit = (before.ratio, after.ratio), 'times the floor'
    noise = z * math.hypot(*(_deviation(side) for side in sides))
    return Change(name, unit, sides[0].value, sides[1].value, noise, after.better)


def _remarks(before, after):
    remarks = []
    for key in ('processor', 'processors', 'kernel'):
        values = [result['machine'].get(key) for result in (before, after)]
        if values[0] != values[1]:
            remarks.append(f'the machines differ: {key} {values[0]} and {values[1]}')
    builds = [result['machine'].get('build') for result in (before, after)]
    if all(builds) and builds[0] != builds[1]:
        remarks.append(f'the programs were built differently: {builds[0]} and {builds[1]}')
    if before['preset'] != after['preset']:
        remarks.append(f"the presets differ: {before['preset']} and {after['preset']}")
    for name, result in (('before', before), ('after', after)):
        remarks += [f'{name}: {warning}' for warning in result['warnings']]
    return remarks


def compare(before, after):
    """Compares two results."""
    ours, theirs = figures_of(before), figures_of(after)
    common = [name for name in ours if name in theirs]
    # Bonferroni: together they err with the probability that one of them may err with.
    z = NormalDist().inv_cdf(1 - (1 - CONFIDENCE) / 2 / max(1, len(common)))
    return Comparison([_change(name, ours[name], theirs[name], z) for name in common],
                      [name for name in ours if name not in theirs], [name for name in theirs if name not in ours],
                      _remarks(before, after))
