# SPDX-License-Identifier: Apache-2.0
"""
Thirty programs of a launch are killed, each at a random moment. The launch ends within 15 s of the last death. Its verdict
is complete only if all is there that was fired; what is missing is counted, or its processor is named.
"""

import os
import signal
import time

from .campaign import Outcome

RUNS = 20
PROGRAMS = 30
LONGEST_END = 15.0  # seconds


def run(place, random):
    place.new_run()
    buffers = random.choice(['uid', 'pid'])
    process = place.start_launch(
        place.trace_tag(buffers_ust=buffers, subbuffer_size_ust=65536),
        *(place.app_tag(number, threads=random.choice([1, 2]), bytes=20, burst=random.choice([1, 5, 20]),
                        pause=random.choice([1000, 5000]), attributes='allowed-exit-codes="any"')
          for number in range(PROGRAMS)))
    until = time.monotonic() + 60
    while (len(place.started()) < PROGRAMS or not place.counts(PROGRAMS - 1)) and time.monotonic() < until:
        time.sleep(0.02)
    pids = list(place.started().values())
    random.shuffle(pids)
    for pid in pids:
        time.sleep(random.uniform(0, 0.1))
        os.kill(pid, random.choice([signal.SIGKILL, signal.SIGKILL, signal.SIGSEGV, signal.SIGTERM]))
    begin = time.monotonic()
    launch = place.end_launch(process, 60)
    outcome = Outcome(buffers, numbers={'end took s': time.monotonic() - begin})
    verdict = place.verdict(place.path('trace'))
    if launch.code is None or verdict is None:
        outcome.wrong.append(f'no verdict, exit code {launch.code}: {launch.output[-500:]}')
        return outcome
    if outcome.numbers['end took s'] > LONGEST_END:
        outcome.wrong.append(f'the end took {outcome.numbers["end took s"]:.1f} s')
    judge(outcome, place, verdict, launch)
    return outcome


def judge(outcome, place, verdict, launch):
    recorded = place.read(place.path('trace'))
    if not recorded.readable:
        outcome.wrong.append(f'babeltrace2: {recorded.error}')
    there = {(process, thread, number) for _, _, thread, number, process in recorded.events}
    missing, last = 0, {}
    for app, pid in place.started().items():
        for thread, record in place.counts(app).items():
            missing += sum((pid, thread, number) not in there for number in range(1, record.done + 1))
            for cpu, (number, _) in record.last.items():
                if (pid, thread, number) not in there:
                    last[cpu] = f'processor {cpu} lacks event {number} of thread {thread} of app_{app}'
    named = {int(part['cpu']) for channel in verdict['channels'] for part in channel.get('unwritten', [])}
    discarded = verdict['discarded_events']
    outcome.result += ', complete' if verdict['complete'] else ', unfinished' if named else ', not complete'
    outcome.numbers.update({'events': len(recorded.events), 'missing': missing})
    if verdict['complete'] and missing:
        outcome.wrong.append(f'complete, but {missing} events are missing: {last}')
    if not verdict['complete'] and not named and abs(missing - discarded) > 3 and not verdict['absent']:
        outcome.wrong.append(f'{missing} events are missing, the verdict has {discarded}: {verdict["damage"]}')
    unnamed = [sentence for cpu, sentence in last.items() if cpu not in named]
    if unnamed and discarded == 0:
        outcome.wrong.append(f'not named: {unnamed}; {verdict["damage"]} {verdict["absent"]}')
    if named and not missing:
        within = sum(record.begun != record.done for app in range(PROGRAMS) for record in place.counts(app).values())
        if within == 0:
            outcome.wrong.append(f'called unfinished, but nothing is missing: {verdict["damage"]}')
