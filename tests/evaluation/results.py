# SPDX-License-Identifier: Apache-2.0
"""
The result of an evaluation as JSON (docs/schema/evaluation.schema.json), and the figures in it.

A figure is one number with its spread, in the form that a comparison of two results needs.
"""

import json
import math
from dataclasses import asdict, dataclass

from .bootstrap import Estimate

FORMAT = 'launch-evaluation'
VERSION = 1


class ResultError(Exception):
    """A file is no result of an evaluation; the message says why."""


@dataclass(frozen=True)
class Figure:
    """
    A measured number.

    `low` and `high` bound it with a confidence of 95 %. `floor` is what the same run measured for the least that is
    possible, in the same unit, and `floor_name` says what that is; `floor_low` and `floor_high` bound it likewise.
    """

    group: str
    name: str
    unit: str
    value: float
    low: float
    high: float
    samples: int
    better: str = 'lower'
    floor: float = None
    floor_low: float = None
    floor_high: float = None
    floor_name: str = None
    note: str = None

    def as_json(self):
        return {key: value for key, value in asdict(self).items() if value is not None}

    @property
    def ratio(self):
        """The ratio to the floor, with its interval; None without a floor. Both are measured independently."""
        if not self.floor:
            return None
        ratio = self.value / self.floor
        widths = [(self.high - self.low) / 2 / self.value if self.value else 0.0]
        if self.floor_low is not None:
            widths.append((self.floor_high - self.floor_low) / 2 / self.floor)
        half = abs(ratio) * math.hypot(*widths)
        return Estimate(ratio, ratio - half, ratio + half)


def figure_of(group, name, unit, estimate, samples, floor=None, **more):
    """A figure of an estimate, and of that of its floor."""
    if floor is not None:
        more.update(floor=floor.value, floor_low=floor.low, floor_high=floor.high)
    return Figure(group, name, unit, estimate.value, estimate.low, estimate.high, samples, **more)


def write(result, path):
    path.write_text(json.dumps({'format': FORMAT, 'version': VERSION, **result}, indent=1) + '\n')


def read(path):
    """Reads a result; raises ResultError for anything else."""
    try:
        with open(path) as file:
            result = json.load(file)
    except OSError as error:
        raise ResultError(f'{path}: {error.strerror}') from None
    except ValueError as error:
        raise ResultError(f'{path}: no JSON: {error}') from None
    if not isinstance(result, dict) or result.get('format') != FORMAT:
        raise ResultError(f'{path}: this is no result of ./dev evaluate')
    if result.get('version') != VERSION:
        raise ResultError(f"{path}: version {result.get('version')} of the format, this program reads version {VERSION}")
    return result


def figures_of(result):
    """Every figure of a result, also those of the experiment, by name."""
    figures = [Figure(**figure) for figure in result.get('figures', [])]
    experiment = result.get('experiment')
    if experiment:
        figures += _figures_of_experiment(experiment)
    return {f'{figure.group}: {figure.name}': figure for figure in figures}


def _figures_of_experiment(experiment):
    samples = experiment['generations']
    for processes, aggregate in experiment['aggregates'].items():
        where = 'two processes' if processes == '2' else 'one process'
        for key, name in (('overhead_merged', 'mean overhead, merged'), ('overhead_of_means', 'mean overhead'),
                          ('overhead_of_medians', 'overhead of the medians')):
            one = aggregate[key]
            yield Figure('experiment', f'{where}, {name}', 'us', one['value'], one['low'], one['high'], samples)
    for one in experiment['combinations']:
        where = 'two processes' if one['processes'] == 2 else 'one process'
        name = f"{where}, {one['bytes'] // 1024} KiB, {one['rate']} Hz"
        for key, what in (('overhead_of_mean', 'overhead of the mean'), ('overhead_of_median', 'overhead of the median')):
            overhead = one[key]['us']
            yield Figure('experiment', f'{name}, {what}', 'us', overhead['value'], overhead['low'], overhead['high'],
                         samples)
        latency = one['untraced_median']
        yield Figure('experiment', f'{name}, untraced median', 'us', latency['value'], latency['low'], latency['high'],
                     samples)
