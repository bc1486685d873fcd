# SPDX-License-Identifier: Apache-2.0
"""What can be measured, by name. Each step adds to the result."""

from dataclasses import dataclass
from pathlib import Path
from typing import Callable

from . import experiment
from .isolation import Place
from .measures import calls, discovery, entities, hosts, layers, local, losses, reading, sessions, stack, start, tracepoints
from .presets import Preset
from .ros2 import OtherRos2
from .session import SessionPlan
from .tuning import Tuning


class StepError(Exception):
    """A step cannot be measured here; the message says why."""


@dataclass(frozen=True)
class Bench:
    """What every step needs."""

    programs: Path  # a build tree
    preset: Preset
    plan: SessionPlan
    tuning: Tuning
    place: Place
    say: Callable
    ros2: OtherRos2 = None  # another installation of ROS 2, to be measured beside this stack

    def program(self, name):
        """A program of the benchmarks."""
        path = self.programs / 'bench' / name
        if not path.exists():
            raise StepError(f'{path} is not built')
        return str(path)

    @property
    def kernel_recorder(self):
        """Records events of the kernel where LTTng has no modules."""
        return str(self.programs / 'prefix/lib/launch/launch-kernel-recorder')


def run_experiment(bench, result):
    run = experiment.Experiment(bench.program('latency_stack'), bench.preset, bench.plan, bench.tuning, bench.place,
                                bench.say)
    run.run()
    result['experiment'] = experiment.result_json(run, bench.plan, bench.preset)


@dataclass(frozen=True)
class Step:
    """How something is measured, and what has to be built for it."""

    run: Callable
    targets: tuple


STEPS = {
    'experiment': Step(run_experiment, ('latency_stack', 'tracetools_provider')),
    'tracepoints': Step(tracepoints.measure, ('bench_tracepoint', 'latency_tracepoints', 'tracetools_provider',
                                              'tracetools_none', 'tracetools_usdt')),
    'sessions': Step(sessions.measure, ('latency_stack', 'latency_tracepoints', 'launch-kernel-recorder',
                                        'tracetools_provider')),
    'layers': Step(layers.measure, ('latency_stack', 'launch-report', 'tracetools_provider')),
    'stack': Step(stack.measure, ('latency_stack', 'latency_bare', 'tracetools_provider')),
    'entities': Step(entities.measure, ('bench_idle_entities', 'tracetools_provider')),
    'calls': Step(calls.measure, ('latency_calls', 'latency_bare_calls', 'tracetools_provider')),
    'local': Step(local.measure, ('latency_local', 'latency_plain_local', 'tracetools_provider')),
    'discovery': Step(discovery.measure, ('latency_discovery', 'latency_bare_discovery', 'tracetools_provider')),
    'losses': Step(losses.measure, ('bench_trace_load', 'tracetools_provider')),
    'hosts': Step(hosts.measure, ('bench_trace_load', 'tracetools_provider')),
    'start': Step(start.measure, ('bench_launch_start', 'launch-guardian', 'launch-exec')),
    'reading': Step(reading.measure, ('bench_reader',)),
}
NAMES = tuple(STEPS)


def targets_of(names):
    """What the steps of these names need; all steps if there are none."""
    return sorted({target for name in names or NAMES for target in STEPS[name].targets})
