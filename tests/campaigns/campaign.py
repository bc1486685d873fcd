# SPDX-License-Identifier: Apache-2.0
"""What the campaigns share: one run's outcome, and the table of all of them."""

import collections
import statistics
from dataclasses import dataclass, field


@dataclass
class Outcome:
    """What one run has shown."""

    result: str                                   # a few words; the table counts them
    wrong: list = field(default_factory=list)     # sentences on what must not be
    numbers: dict = field(default_factory=dict)   # what was measured, by name


def table(name, outcomes):
    """The lines of a table: how often each result came, and the span of each number."""
    results = collections.Counter(outcome.result for outcome in outcomes)
    wrong = sum(bool(outcome.wrong) for outcome in outcomes)
    rows = [(result, str(count)) for result, count in sorted(results.items(), key=lambda row: -row[1])]
    rows.append(('wrong', str(wrong)))
    numbers = collections.defaultdict(list)
    for outcome in outcomes:
        for key, value in outcome.numbers.items():
            numbers[key].append(value)
    for key, values in numbers.items():
        rows.append((key, f'{_number(min(values))} to {_number(max(values))}, median '
                          f'{_number(statistics.median(values))}, sum {_number(sum(values))}'))
    width = max(len(row[0]) for row in rows)
    head = f'{name}: {len(outcomes)} runs'
    return [head, '-' * len(head), *(f'{key:{width}}  {value}' for key, value in rows)]


def _number(value):
    return f'{value:.2f}' if isinstance(value, float) else str(value)
