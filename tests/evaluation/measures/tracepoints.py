# SPDX-License-Identifier: Apache-2.0
"""
The cost of a tracepoint: by payload, context fields and backend, called in a loop (warm) and at the pace of messages (cold).

Each repetition is a process of its own, because the place of a program in memory matters.
"""

import json
import struct

from .. import paper
from ..bootstrap import of_samples
from ..results import figure_of
from ..session import Session, SessionPlan
from ..worker import Worker
from .benchmark import run

GROUP = 'cost of a tracepoint'
NAMES = {
    'LibraryTracepoint': 'two pointers',
    'LibraryTracepointWithNumber': 'two pointers and a number',
    'InlineTracepoint': "two pointers, LTTng's macro in the caller's code",
    'InlineTracepointWithText': 'a pointer and 32 characters, likewise',
}
PLANS = (
    ('recorded, no context fields', SessionPlan('no-contexts')),
    ('recorded, vpid and vtid', SessionPlan('two-contexts', contexts=('vpid', 'vtid'))),
    ('recorded, vpid, vtid and procname', SessionPlan('three-contexts', contexts=('vpid', 'vtid', 'procname'))),
)
PATH_TRACEPOINTS = 9
PACES_HZ = (100, 1000, 2500)


def _times(bench, environment=None):
    """Nanoseconds of processor time for each case of bench_tracepoint."""
    seconds = max(0.005, 0.05 * min(4, bench.preset.scale))
    printed = run([bench.program('bench_tracepoint'), '--benchmark_format=json', f'--benchmark_min_time={seconds}'],
                  environment)
    return {one['name']: one['cpu_time'] for one in json.loads(printed)['benchmarks']}


def _add(bench, result, what, environment=None, cases=tuple(NAMES), note=None):
    runs = [_times(bench, environment) for _ in range(bench.preset.repetitions)]
    floor = of_samples([one['EmptyCall'] for one in runs])
    for case in cases:
        result['figures'].append(figure_of(
            GROUP, f'{what}: {NAMES[case]}', 'ns', of_samples([one[case] for one in runs]), len(runs), floor=floor,
            floor_name='a call of an empty function', note=note if case == 'LibraryTracepoint' else None))


def backends(bench, *names):
    """Those of these libraries that are built and stand in for that of LTTng: the name, and what chooses it."""
    for name in names:
        library = bench.programs / 'prefix/lib/tracetools/backends' / name / 'libtracetools.so'
        if library.exists():
            yield name, {'LD_PRELOAD': str(library)}


def _at_pace(bench, result):
    """The nine tracepoints of a message's way, while a session records them."""
    warm, cold = [], {rate: [] for rate in PACES_HZ}
    rates = PACES_HZ[-1:] if bench.preset.name == 'tiny' else PACES_HZ
    with Session(SessionPlan('path'), bench.place.directory) as session:
        for _ in range(bench.preset.repetitions):
            with Worker(bench.program('latency_tracepoints'), '', 0, bench.tuning) as worker:
                session.start()
                for rate in rates:
                    worker.send(struct.pack('=qQ', round(1e9 / rate), 1024))
                    in_a_loop, at_pace = struct.unpack('=dd', worker.receive(16))
                    cold[rate].append(at_pace * 1e3 / PATH_TRACEPOINTS)
                warm.append(in_a_loop * 1e3 / PATH_TRACEPOINTS)
                session.stop()
    result['figures'].append(figure_of(GROUP, "warm: one of a message's nine, called in a loop", 'ns', of_samples(warm), len(warm)))
    for rate in rates:
        result['figures'].append(figure_of(
            GROUP, f"cold: one of a message's nine, called {rate} times a second", 'ns', of_samples(cold[rate]),
            len(cold[rate]), floor=of_samples(warm), floor_name='the same, warm'))


def measure(bench, result):
    _add(bench, result, 'idle')
    for name, environment in backends(bench, 'none', 'usdt'):
        _add(bench, result, f'backend {name}, nobody listens', environment, cases=('LibraryTracepoint',))
    for name, plan in PLANS:
        with Session(plan, bench.place.directory) as session:
            session.start()
            _add(bench, result, name, note=None if plan.contexts else f'the paper: {paper.TRACEPOINT_NS} ns')
            session.stop()
    _at_pace(bench, result)
