# SPDX-License-Identifier: Apache-2.0
"""
How many machines one relay daemon carries: the part of the events that is lost, and what the relay daemon costs.

Each machine is a mount namespace with a session daemon and a consumer of its own, whose traced programs fire events at a
fixed rate. All send to one relay daemon through the loopback network, and share the processors of this machine with it.
"""

import json
import os
import subprocess
import time

from ..bootstrap import Estimate, of_samples
from ..results import figure_of
from .benchmark import BenchmarkError

GROUP = 'machines that send to one relay daemon'
MACHINES = (1, 2, 4, 8)
RATE = 200_000  # events a second of each machine
PROGRAMS = 2   # of each machine
SUBBUFFER_SIZE, SUBBUFFERS = 1024 * 1024, 4
READ_TIMER_US = 50_000
RUNS = 3


def _lost(file):
    """The part of the events, in per cent, that one machine reports."""
    samples = [json.loads(line) for line in file.read_text().splitlines()]
    return next(one['values'][0] for one in samples if one['unit'] == '%')


def _run(bench, machines, seconds):
    """(per cent of the events that all machines have lost, per cent of a processor that the relay daemon took)"""
    command = [bench.program('bench_trace_load'), PROGRAMS, RATE, seconds, SUBBUFFER_SIZE, SUBBUFFERS, READ_TIMER_US,
               'net://127.0.0.1']
    files = [bench.place.directory / f'machine-{number}' for number in range(machines)]
    before, began = bench.place.relay_seconds(), time.monotonic()
    running = [subprocess.Popen([str(word) for word in command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                                env={**os.environ, 'BENCHMARK_SAMPLES': str(file)}) for file in files]
    for process in running:
        _, errors = process.communicate(timeout=600)
        if process.returncode != 0:
            raise BenchmarkError(f'bench_trace_load failed: {(errors.strip() or "it says nothing").splitlines()[-1]}')
    took = time.monotonic() - began
    lost = [_lost(file) for file in files]
    for file in files:
        file.unlink()
    return sum(lost) / len(lost), 100 * (bench.place.relay_seconds() - before) / took


def measure(bench, result):
    tiny = bench.preset.name == 'tiny'
    bench.place.start_relay()
    for machines in MACHINES[:2] if tiny else MACHINES:
        runs = [_run(bench, machines, max(1, round(2 * bench.preset.scale))) for _ in range(2 if tiny else RUNS)]
        what = f'{machines} machine{"s" if machines > 1 else ""}, {machines * RATE:,} events/s'
        for index, (name, unit) in enumerate((('lost', '%'), ('relay daemon', '% of a processor'))):
            part = of_samples([run[index] for run in runs])
            part = Estimate(part.value, max(0.0, part.low), min(100.0, part.high))
            result['figures'].append(figure_of(GROUP, f'{what}, {name}', unit, part, len(runs)))
