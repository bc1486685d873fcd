# SPDX-License-Identifier: Apache-2.0
"""What part of the events is lost, by their rate and the size of sub-buffers, and what the consumer costs."""

from .benchmark import samples_of
from ..bootstrap import Estimate, of_samples
from ..results import figure_of

GROUP = 'losses'
NODES = 10
RATES = (100_000, 400_000, 1_600_000)  # events a second
BUFFERS = ((32 * 1024, 2), (256 * 1024, 4), (1024 * 1024, 4))  # bytes, number; the last is the default
READ_TIMER_US = 50_000
RUNS = 3


def measure(bench, result):
    """Each point several times; a loss is not a matter of one run."""
    seconds = max(1, round(bench.preset.scale))
    tiny = bench.preset.name == 'tiny'
    collected = {}
    for _ in range(RUNS if not tiny else 2):
        for rate in RATES[:1] if tiny else RATES:
            for size, count in BUFFERS[-1:] if tiny else BUFFERS:
                command = [bench.program('bench_trace_load'), NODES, rate, seconds, size, count, READ_TIMER_US]
                for samples in samples_of(bench, command):
                    collected.setdefault((samples['name'], samples['unit'], samples['better']), []).extend(samples['values'])
    for (name, unit, better), values in collected.items():
        result['figures'].append(figure_of(GROUP, name, unit, _possible(of_samples(values), unit), len(values), better=better))


def _possible(estimate, unit):
    """Of a part, the interval ends at nothing and at all."""
    if unit != '%':
        return estimate
    return Estimate(estimate.value, max(0.0, estimate.low), min(100.0, estimate.high))
