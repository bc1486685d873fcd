# SPDX-License-Identifier: Apache-2.0
"""
Start-up and discovery: until a program has published, until its first message has come to a subscriber that waits, until 10
and more nodes, a process each, have found all others, and their memory then.

All times begin before the (first) program is started. The floor is the same on bare Fast DDS.
"""

import struct

from ..bootstrap import of_samples
from ..results import figure_of
from ..worker import Worker, WorkerError
from . import turns
from .stack import OWN

GROUP = 'start-up and discovery'
BARE = 'bare Fast DDS'
STARTS = 2  # for each repetition of the preset
RUNS = {2: 2, 10: 5, 30: 3, 100: 3}  # of the discovery of so many nodes, in every preset: it takes long
DISCOVERY_PATIENCE = 600  # seconds
FIRST = (('from the start of a program to its main()', 0), ('from the start of a program to its first publish()', 1),
         ('from the start of a program to its first message in another process', 2))


def _programs(bench):
    yield OWN, bench.program('latency_discovery'), {}
    yield BARE, bench.program('latency_bare_discovery'), {}
    if bench.ros2:
        yield bench.ros2.name, bench.ros2.program('latency_discovery'), bench.ros2.environment


def _start(bench, program, environment):
    """Milliseconds until main(), until the first message was published, and until it has come."""
    with Worker(program, 'listener', 1, bench.tuning, environment) as listener:
        listener.expect_ready()
        with Worker(program, 'first', 0, bench.tuning, environment) as first:
            times = struct.unpack('=qqq', listener.receive(24))
            first.finish()
        return [(time - first.started) / 1e6 for time in times]


def _discover(program, environment, count):
    """Milliseconds until each of so many nodes has found the endpoints of all, and megabytes for each."""
    nodes = []
    try:
        for _ in range(count):
            nodes.append(Worker(program, f'one_of {count}', None, None, environment))
        found = max(struct.unpack('=q', node.receive(8, DISCOVERY_PATIENCE))[0] for node in nodes)
        return (found - nodes[0].started) / 1e6, sum(node.proportional_kib() for node in nodes) / 1024 / count
    finally:
        for node in nodes:
            node.close()


def _add(result, what, unit, values_of):
    """A figure for each program; bare Fast DDS is the floor of the others, and no figure of its own."""
    floor = of_samples(values_of[BARE])
    for name, values in values_of.items():
        if name != BARE:
            result['figures'].append(figure_of(GROUP, f'{name}: {what}', unit, of_samples(values), len(values), floor=floor,
                                               floor_name=BARE))


def measure(bench, result):
    programs = list(_programs(bench))
    starts = {name: [] for name, *_ in programs}
    for _ in range(STARTS * bench.preset.repetitions):
        for number, (name, program, environment) in enumerate(programs):
            starts[name].append(_start(bench, program, {**environment, **turns.domain(number)}))
    for what, index in FIRST:
        _add(result, what, 'ms', {name: [one[index] for one in times] for name, times in starts.items()})
    for count in bench.preset.nodes:
        _measure_discovery(result, programs, count)


def _measure_discovery(result, programs, count):
    what = f'{count} nodes, a process each'
    found = {name: [] for name, *_ in programs}
    try:
        for run in range(RUNS[count]):
            for number, (name, program, environment) in enumerate(programs):
                # A domain that no killed node has used.
                variables = {**environment, **turns.domain(count + run * len(programs) + number)}
                found[name].append(_discover(program, variables, count))
    except WorkerError as error:
        result['left_out'].append({'what': what, 'reason': f'not all have found all others in {DISCOVERY_PATIENCE} s: {error}'})
        return
    _add(result, f'{what}: until all know all', 'ms', {name: [time for time, _ in runs] for name, runs in found.items()})
    _add(result, f'{what}: memory of one, its part of what they share', 'MiB',
         {name: [memory for _, memory in runs] for name, runs in found.items()})
