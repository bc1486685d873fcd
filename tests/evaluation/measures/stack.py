# SPDX-License-Identifier: Apache-2.0
"""
The latency of the stack itself beside bare Fast DDS, beside itself without tracepoints that could be switched on, and beside
another rclcpp if there is one.
"""

from ..bootstrap import median, of_samples
from ..presets import SIZES
from ..results import figure_of
from ..worker import Exchange
from . import turns
from .tracepoints import backends

GROUP = 'latency of the stack'
RATE = 1000
BATCH_SECONDS = 0.15
OWN = 'this stack'
BARE = 'bare Fast DDS with a wait set'


class BareExchange(Exchange):
    """bench_latency's floor: its subscriber has another role."""

    subscriber_role = 'wait_set'


def _contestants(bench, processes):
    """All that take turns; the stack comes first."""
    def exchange(name, program, environment=None, kind=Exchange):
        return turns.Contestant(name, lambda variables: kind(program, processes, bench.tuning, variables), environment or {})

    own = bench.program('latency_stack')
    yield exchange(OWN, own)
    yield exchange(f'{OWN}, tracing disabled', own, {'TRACETOOLS_RUNTIME_DISABLE': '1'})
    for name, environment in backends(bench, 'none'):
        yield exchange(f'{OWN}, backend {name}', own, environment)
    if processes == 2:
        yield exchange(BARE, bench.program('latency_bare'), kind=BareExchange)
    if bench.ros2:
        yield exchange(bench.ros2.name, bench.ros2.program('latency_stack'), bench.ros2.environment)


def measure(bench, result):
    conditions = [turns.Condition(SIZES.index(size), RATE) for size in bench.preset.sizes]
    for processes in bench.preset.processes:
        medians = turns.measure(bench.preset, list(_contestants(bench, processes)), conditions, BATCH_SECONDS)
        _add_figures(bench, result, processes, medians)


def _add_figures(bench, result, processes, medians):
    where = 'two processes' if processes == 2 else 'one process'
    floor_name = BARE if processes == 2 else f'{OWN}, tracing disabled'
    for name, one in medians.items():
        for index, size in enumerate(bench.preset.sizes):
            floor = {}
            if name != floor_name:
                floor = {'floor': medians[floor_name].estimate(index), 'floor_name': floor_name}
            result['figures'].append(figure_of(
                GROUP, f'{name}, {where}, {size // 1024} KiB, {RATE} Hz, median', 'us', one.estimate(index), one.batches,
                **floor))
        result['figures'].append(figure_of(GROUP, f'{name}, {where}, resident memory', 'MiB',
                                           of_samples(one.memory_mib, median), len(one.memory_mib)))
