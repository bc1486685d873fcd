# SPDX-License-Identifier: Apache-2.0
"""
`lttng rotate` beside a launch in which a process is killed within an event. The launch ends within 15 s of the end of its
processes, and leaves a verdict that is not complete.
"""

import subprocess
import time

from .campaign import Outcome
from .place import lttng

RUNS = 20
LONGEST_END = 15.0  # seconds


def run(place, random):
    place.new_run()
    rotate_first = random.random() < 0.3
    die = f'<executable name="dies" cmd="{place.interrupted_app} 20 die" allowed-exit-codes="SIGKILL"/>'
    delay = random.uniform(0.1, 0.5)
    process = place.start_launch(
        place.trace_tag(events_ust='campaign:* ros2:rclcpp_take'),
        place.app_tag(0, threads=2, burst=20, pause=2000, bytes=20),
        f'<timer period="{delay:.3f}">{die}</timer>')
    # The app runs until it is told to stop, so the session is there.
    until = time.monotonic() + 30
    while not place.counts() and time.monotonic() < until:
        time.sleep(0.01)
    if not rotate_first:
        while 'dies' not in place.path('launch.log').read_text(encoding='utf-8') and time.monotonic() < until:
            time.sleep(0.01)
        time.sleep(random.uniform(0, 0.3))
    # The command may wait for the end of the rotation, as a user's does.
    waits = random.random() < 0.5
    rotation = subprocess.Popen(('lttng', 'rotate', 'trace', *(() if waits else ('--no-wait',))),
                                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    time.sleep(random.uniform(0.3, 1.5) + (delay if rotate_first else 0))
    # On a busy machine it may not have come to its last event yet.
    while 'process has' not in place.path('launch.log').read_text(encoding='utf-8') and time.monotonic() < until:
        time.sleep(0.01)
    begin = time.monotonic()
    process.send_signal(2)
    launch = place.end_launch(process, 60)
    took = time.monotonic() - begin
    rotation.kill()
    rotation.wait()
    verdict = place.verdict(place.path('trace'))
    outcome = Outcome('rotated before the death' if rotate_first else 'rotated after the death',
                      numbers={'end took s': took})
    if launch.code is None:
        outcome.wrong.append('the launch did not end within 60 s')
    elif took > LONGEST_END:
        outcome.wrong.append(f'the end took {took:.1f} s')
    if verdict is None:
        outcome.wrong.append(f'no verdict: {launch.output[-500:]}')
    elif verdict['complete'] or not verdict['damage']:
        outcome.wrong.append(f'complete: {verdict["complete"]}, damage: {verdict["damage"]}')
    if 'No session' not in lttng('list').stdout + lttng('list').stderr and 'trace' in lttng('list').stdout:
        outcome.wrong.append('the session is still there')
    return outcome
