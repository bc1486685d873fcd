# SPDX-License-Identifier: Apache-2.0
"""What idle entities in an executor add to a message within a process."""

from ..bootstrap import median, of_samples
from ..results import figure_of
from .benchmark import samples_of

GROUP = 'executors with idle entities'
PROGRAM = 'bench_idle_entities'
COUNTS = (1, 10, 100, 1000)


def measure(bench, result):
    """Each run is a process of its own, in turns with those of another rclcpp; the median of its batches is one sample."""
    programs = [('', bench.program(PROGRAM), {})]
    if bench.ros2:
        programs.append((f'{bench.ros2.name}: ', bench.ros2.program(PROGRAM), bench.ros2.environment))
    runs = {name: [] for name, *_ in programs}
    for _ in range(bench.preset.repetitions):
        for name, program, environment in programs:
            runs[name].append(samples_of(bench, [program, *COUNTS], environment))
    for name, samples in runs.items():
        _add(result, name, samples)


def _add(result, program, runs):
    for lines in zip(*runs):
        first = lines[0]
        floor = {}
        if first['floor']:
            floor = {'floor': of_samples([median(line['floor']) for line in lines]), 'floor_name': first['floor_name']}
        result['figures'].append(figure_of(GROUP, program + first['name'], first['unit'],
                                           of_samples([median(line['values']) for line in lines]), len(lines), **floor))
