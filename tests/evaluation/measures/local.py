# SPDX-License-Identifier: Apache-2.0
"""
What stays within a process: how late a timer's callback runs, and messages that rclcpp hands over itself.

The floor of a timer is a loop that sleeps until the next time. That of a message is a locked queue with an eventfd, which the
same thread waits for: it neither looks for subscriptions nor wakes an executor.
"""

from ..presets import SIZES
from ..results import figure_of
from ..worker import Caller
from . import turns
from .stack import OWN

GROUP = 'timers and intra-process communication'
BATCH_SECONDS = 0.15
TIMER_HZ = (100, 1000)
MESSAGE_HZ = 1000
FLOOR = 'floor'


def _medians(bench, role, floor_role, conditions):
    def alone(name, program, role, environment=None):
        return turns.Contestant(name, lambda variables: Caller(program, role, None, bench.tuning, variables),
                                environment or {})

    contestants = [alone(OWN, bench.program('latency_local'), role),
                   alone(FLOOR, bench.program('latency_plain_local'), floor_role)]
    if bench.ros2:
        contestants.append(alone(bench.ros2.name, bench.ros2.program('latency_local'), role, bench.ros2.environment))
    return turns.measure(bench.preset, contestants, conditions, BATCH_SECONDS)


def _add(result, medians, index, what, floor_name):
    for name, one in medians.items():
        if name != FLOOR:
            result['figures'].append(figure_of(GROUP, f'{name}: {what}', 'us', one.estimate(index), one.batches,
                                               floor=medians[FLOOR].estimate(index), floor_name=floor_name))


def measure(bench, result):
    medians = _medians(bench, 'timer', 'sleep', [turns.Condition(0, rate) for rate in TIMER_HZ])
    for index, rate in enumerate(TIMER_HZ):
        _add(result, medians, index, f'a timer at {rate} Hz, how late its callback runs, median', 'a loop that sleeps')
    conditions = [turns.Condition(SIZES.index(size), MESSAGE_HZ) for size in bench.preset.sizes]
    medians = _medians(bench, 'intra_process', 'queue', conditions)
    for index, size in enumerate(bench.preset.sizes):
        _add(result, medians, index, f'intra-process, {size // 1024} KiB, {MESSAGE_HZ} Hz, median', 'a locked queue')
