# SPDX-License-Identifier: Apache-2.0
"""Where a message spends its time: its latency by layers, as `launch report` splits it from a trace."""

import json

from ..bootstrap import of_samples
from ..presets import SIZES
from ..results import figure_of
from ..session import DEFAULT, Session
from ..worker import Exchange
from .benchmark import BenchmarkError, run

GROUP = 'latency by layers'
RATE = 1000
BATCH_SECONDS = 0.4
# The parts of docs/report.md, on the way of a message.
PARTS = (('latency', 'from the first publish function to the callback'), ('rclcpp', 'in rclcpp, publishing'),
         ('rcl', 'in rcl, publishing'), ('transport', 'on the way, while the executor waits for work'),
         ('executor', 'waiting for the executor, which is busy'), ('take', 'from the take to the callback'))


def _medians(report, topic):
    """Microseconds for each part, of the subscription to a topic."""
    for one in report['subscriptions']:
        if one['topic'] == topic:
            return {part: one[part]['p50_ns'] / 1e3 for part, _ in PARTS if one.get(part)}
    raise BenchmarkError(f'the trace has no messages of {topic}')


def measure(bench, result):
    report_program = bench.programs / 'prefix/lib/launch/launch-report'
    messages = max(10, round(BATCH_SECONDS * bench.preset.scale * RATE))
    for processes in bench.preset.processes:
        runs = {size: [] for size in bench.preset.sizes}
        for _ in range(bench.preset.repetitions):
            with Session(DEFAULT, bench.place.directory) as session:
                session.start()
                with Exchange(bench.program('latency_stack'), processes, bench.tuning) as exchange:
                    for size in bench.preset.sizes:
                        exchange.run(SIZES.index(size), messages, RATE)
                    session.finish()
                report = json.loads(run([report_program, session.directory, '--json']))
            for size in bench.preset.sizes:
                runs[size].append(_medians(report, f'/bytes_{size}'))
        where = 'two processes' if processes == 2 else 'one process'
        for size, medians in runs.items():
            for part, meaning in PARTS:
                values = [one[part] for one in medians if part in one]
                if values:
                    result['figures'].append(figure_of(GROUP, f'{where}, {size // 1024} KiB, {RATE} Hz: {meaning}', 'us',
                                                       of_samples(values), len(values)))
