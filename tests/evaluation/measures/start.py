# SPDX-License-Identifier: Apache-2.0
"""How long a launch of 1 to 2,000 processes takes to start and to stop, beside a bare loop."""

from .benchmark import figure, samples_of

GROUP = 'start and stop of processes'
COUNTS = (1, 10, 100, 500, 1000, 2000)
RUNS = {1: 3, 10: 3, 100: 2, 500: 1, 1000: 1, 2000: 1}  # times the repetitions of the preset, fewer for many


def measure(bench, result):
    for count in COUNTS:
        if bench.preset.name == 'tiny' and count > 10:
            break
        runs = max(2, round(bench.preset.repetitions * RUNS[count] * (1 if count < 500 else 0.6)))
        for samples in samples_of(bench, [bench.program('bench_launch_start'), runs, count]):
            result['figures'].append(figure(GROUP, samples))
