# SPDX-License-Identifier: Apache-2.0
"""
A healthy system at load, for ten minutes: nodes that talk, programs that fire, some that end early, a session that is
rotated, asked for its state, and recorded by a flight recorder beside. There is no warning, and every verdict is complete.
"""

import re
import signal
import subprocess
import time

from .campaign import Outcome
from .place import lttng

RUNS = 30


def run(place, random):
    place.new_run()
    buffers = random.choice(['uid', 'uid', 'pid'])
    short = ''.join(f'<timer period="{random.uniform(1, 10):.2f}">'
                    + place.app_tag(10 + number, threads=2, events=500, bytes=20) + '</timer>' for number in range(8))
    process = place.start_launch(
        place.trace_tag(buffers_ust=buffers, events_ust='campaign:* ros2:*', launch_events='true'),
        place.trace_tag('flight', snapshot_on_signal='SIGUSR1', events_ust='campaign:* ros2:*'),
        *('<node pkg="demo_nodes" exec="talker"/><node pkg="demo_nodes" exec="listener"/>' for _ in range(2)),
        *(place.app_tag(number, threads=2, bytes=50, burst=100, pause=20_000) for number in range(2)), short,
        '<timer period="15"><shutdown/></timer>')
    rotates = random.random() < 0.5
    started = time.monotonic() + 30
    while not place.counts(1) and time.monotonic() < started:
        time.sleep(0.02)
    until = time.monotonic() + 12
    while time.monotonic() < until and process.poll() is None:
        time.sleep(random.uniform(0.5, 2))
        action = random.choice(['status', 'status', 'snapshot', 'rotate'])
        if action == 'status':
            subprocess.run((place.program, 'trace', 'status', 'trace'), stdout=subprocess.DEVNULL)
        elif action == 'snapshot' and time.monotonic() < until - 5:
            process.send_signal(signal.SIGUSR1)
        elif rotates:
            lttng('rotate', 'trace')
    launch = place.end_launch(process)
    outcome = Outcome(buffers + (', rotated' if rotates else ''), numbers={'launch took s': launch.seconds})
    if launch.code != 0:
        outcome.wrong.append(f'exit code {launch.code}')
    outcome.wrong += [line for line in launch.output.splitlines() if re.match(r'\[(WARNING|ERROR)\] \[launch', line)]
    snapshots = sorted(place.path('flight').glob('snapshot-*'))
    outcome.numbers['snapshots'] = len(snapshots)
    for directory in (place.path('trace'), *snapshots):
        verdict = place.verdict(directory)
        if verdict is None or not verdict['complete']:
            outcome.wrong.append(f'{directory.name} is not complete: {verdict and (verdict["damage"], verdict["absent"], verdict["discarded_events"])}')
    return outcome
