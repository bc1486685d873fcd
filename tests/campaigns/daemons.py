# SPDX-License-Identifier: Apache-2.0
"""
LTTng's session daemon, consumer and relay daemon, stopped (SIGSTOP) and killed at a random moment of a launch: before, in
and after its run. While the system runs, the launch says within a second what has happened. It ends within 15 s after it
was asked to, with a verdict that is true, and leaves nothing behind.
"""

import os
import signal
import subprocess
import time
from pathlib import Path

from .campaign import Outcome
from .place import lttng

DAEMONS = {'lttng-sessiond': 'session daemon', 'lttng-consumerd': "LTTng's consumer", 'lttng-relayd': 'relay daemon'}
ACTS = {'stopped': signal.SIGSTOP, 'killed': signal.SIGKILL}
RUNS = 20 * len(DAEMONS) * len(ACTS)
LONGEST_END = 15.0  # seconds
LONGEST_SILENCE = 1.0
BUSY = 1.5  # what a sentence takes beside other work, more than LONGEST_SILENCE
RUNNING = 'writing tracing session to'


def runs(place, random, count):
    cases = [(name, act) for name in DAEMONS for act in ACTS]
    for number in range(count):
        yield run(place, random, *cases[number % len(cases)])


def run(place, random, name, act):
    place.new_run()
    over_network = name == 'lttng-relayd'
    if over_network:
        place.start_relay()
    where = {'url': 'net://127.0.0.1'} if over_network else {}
    begin = time.monotonic()
    process = place.start_launch(place.trace_tag(**where),
                                 place.app_tag(0, threads=2, burst=20, pause=2000, bytes=20),
                                 place.app_tag(1, threads=1, burst=20, pause=2000, bytes=20))
    asked = begin + random.uniform(1, 2.5)  # Ctrl-C
    moment = random.uniform(begin, asked + 0.05)  # an end in which nothing happens takes about as long
    acted = None
    while process.poll() is None and (acted is None or asked is not None):
        now = time.monotonic()
        if acted is None and now >= moment:
            acted = act_on(place, name, act)
        if asked is not None and now >= asked:
            process.send_signal(signal.SIGINT)
            asked, end = None, time.monotonic()
        if acted and acted.said is None and says(place, name, acted):
            acted.said = time.monotonic() - acted.time
        time.sleep(0.01)
    if asked is not None:
        end = time.monotonic()  # it has ended by itself
    launch = place.end_launch(process, 60)
    took = time.monotonic() - end
    phase = 'in the run' if acted and acted.running and acted.time < end - BUSY else 'at its edges'
    outcome = Outcome(f'{name} {act} {phase}' if acted else f'{name}: the launch was over', numbers={'end took s': took})
    if acted and acted.said is not None:
        outcome.numbers[f'{name} {act}, said after s'] = acted.said
    if phase == 'in the run' and (acted.said is None or acted.said > LONGEST_SILENCE):
        outcome.wrong.append(f'{name} {act}: said after {acted.said} s')
    if launch.code is None:
        outcome.wrong.append(f'{name} {act}: the launch did not end within 60 s')
    elif took > LONGEST_END:
        outcome.wrong.append(f'{name} {act}: the end took {took:.1f} s')
    outcome.wrong += [f'{name} {act}: {sentence}' for sentence in
                      [*untrue(place, launch, over_network), *left_behind(place, launch)]]
    if outcome.wrong:
        outcome.wrong.append(launch.output[-2000:])
    return outcome


class Act:
    def __init__(self, log):
        self.time = time.monotonic()
        self.offset = len(log)
        self.running = RUNNING in log
        self.said = None


def log_of(place):
    return place.path('launch.log').read_text(encoding='utf-8', errors='replace')


def name_of(pid):
    try:
        return Path(f'/proc/{pid}/comm').read_text(encoding='utf-8').strip()
    except OSError:
        return ''


def act_on(place, name, act):
    """None: there is no such daemon yet, or any more."""
    # Its helpers have the same command line.
    found = [pid for pid in place.daemons(name) if name_of(pid) == name]
    for pid in found:
        try:
            os.kill(pid, ACTS[act])
        except OSError:
            return None
    return Act(log_of(place)) if found else None


def says(place, name, acted):
    return any(DAEMONS[name] in line for line in log_of(place)[acted.offset:].splitlines() if 'WARN' in line or 'ERROR' in line)


def untrue(place, launch, over_network):
    """What the verdict says and is not so."""
    fired = sum(thread.done for number in (0, 1) for thread in place.counts(number).values())
    if fired == 0:
        return []  # the session has not begun
    trace = place.path('relayed') if over_network else place.path('trace')
    verdict = place.verdict(trace)
    if over_network:
        complete = 'trace is complete' in launch.output
        lost = 0
    elif verdict is None:
        return ['there is no verdict']
    else:
        complete = verdict['complete']
        lost = verdict['discarded_events']
    if not complete and (over_network or verdict['damage'] or verdict['absent'] or verdict['cut_short']):
        return []  # no number is told, or it is not all that is missing
    recorded = place.read(trace)
    if not recorded.readable:
        return [f'no damage is told, but the trace cannot be read: {recorded.error}']
    if abs(fired - len(recorded.events) - lost) > 3:
        return [f'{fired} fired, {len(recorded.events)} recorded, {lost} lost']
    return []


def left_behind(place, launch):
    left = [f'{name} is left' for name in ('launch', 'launch-guardian', 'firing_app', 'launch-trace-guard')
            if place.daemons(name)]
    stopped = [pid for pid in place.daemons('lttng-sessiond')
               if Path(f'/proc/{pid}/stat').read_text(encoding='utf-8').rsplit(')', 1)[1].split()[0] == 'T']
    if not stopped:
        try:
            listed = lttng('list').stdout
        except subprocess.TimeoutExpired:
            listed = 'the session daemon does not answer'
        # A consumer that is killed while it gets a new channel leaves the session daemon waiting for it for ever.
        if ('trace' in listed or 'answer' in listed) and 'kill -9' not in launch.output:
            left.append(f'a session is left: {listed}')
    elif launch.code is not None and not any(
            said in launch.output for said in ('trace stop', 'trace is', 'tracing setup failed')):
        left.append('the session daemon is stopped, and nothing says how to end its session')
    left += [f'{path} is left' for path in Path('/dev/shm').glob('launch-event-counters*')]
    return left
