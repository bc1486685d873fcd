# SPDX-License-Identifier: Apache-2.0
"""How fast a trace is read, beside babeltrace2 on the same trace."""

from .benchmark import figure, samples_of

GROUP = 'reading a trace'
EVENTS = 1_000_000


def measure(bench, result):
    for samples in samples_of(bench, [bench.program('bench_reader'), max(10_000, round(EVENTS * min(4, bench.preset.scale)))]):
        result['figures'].append(figure(GROUP, samples))
