# SPDX-License-Identifier: Apache-2.0
"""
A program crashes while its other threads fire without pause, and the flight recorder takes a snapshot.

Each snapshot holds the last events that every thread fired on every processor, by the program's own record, or its
verdict is not complete and names the processor that lacks some.
"""

from .campaign import Outcome

RUNS = 50


def run(place, random):
    place.new_run()
    threads = random.choice([2, 3, 4])
    launch = place.launch(
        place.trace_tag(snapshot_on_crash='true', subbuffer_size_ust=65536),
        place.app_tag(threads=threads, bytes=random.choice([8, 40, 200]), crash=random.randint(50_000, 400_000),
                      attributes='allowed-exit-codes="SIGSEGV"'))
    outcome = Outcome('', numbers={'launch took s': launch.seconds})
    snapshots = sorted(place.path('trace').glob('snapshot-*'))
    verdict = place.verdict(snapshots[0]) if len(snapshots) == 1 else None
    if launch.code is None or verdict is None:
        outcome.wrong.append(f'{len(snapshots)} snapshots, verdict: {verdict is not None}, exit code {launch.code}')
        outcome.result = 'no verdict'
        return outcome
    recorded = place.read(snapshots[0])
    if not recorded.readable:
        outcome.wrong.append(f'babeltrace2: {recorded.error}')
    judge(outcome, verdict, place.counts(), recorded)
    outcome.numbers['events'] = len(recorded.events)
    return outcome


def lacking(fired, recorded, process=None):
    """The processors whose last events are not in the snapshot, each with a sentence."""
    events = [event for event in recorded.events if process in (None, event[4])]
    there = {(thread, number) for _, _, thread, number, _ in events}
    first = {}
    for time, cpu, *_ in recorded.events:
        first[cpu] = min(time, first.get(cpu, time))
    lacks = {}
    for thread, record in fired.items():
        for cpu, (number, time) in record.last.items():
            # What was fired before the oldest event of the processor was overwritten, as asked.
            if time >= first.get(cpu, 0) and (thread, number) not in there:
                lacks[cpu] = f'processor {cpu}: event {number} of thread {thread} is not in the snapshot'
    return lacks


def judge(outcome, verdict, fired, recorded):
    lacks = lacking(fired, recorded)
    within = sum(record.begun != record.done for record in fired.values())
    parts = [part for channel in [verdict, *verdict.get('channels', [])] for part in channel.get('unwritten', [])]
    unfinished = {int(part['cpu']) for part in parts}
    named = unfinished | {int(part['cpu']) for part in verdict.get('lost', [])}
    for cpu, sentence in lacks.items():
        if verdict['complete']:
            outcome.wrong.append(f'complete, but {sentence}')
        elif cpu not in named:
            outcome.wrong.append(f'not named: {sentence}; damage: {verdict["damage"]}')
    if unfinished and not lacks and within == 0:
        outcome.wrong.append(f'called unfinished, but nothing is missing: {verdict["damage"]}')
    if not fired:
        outcome.wrong.append('nothing was fired')
    outcome.result = ('complete' if verdict['complete']
                      else f'unfinished, named {len(named)} of the processors' if unfinished
                      else f'events lost, named {len(named)} of the processors')
    if not verdict['complete'] and not named and (verdict['discarded_events'], verdict['lost_packets']) == (0, 0):
        outcome.wrong.append(f'not complete: {verdict["damage"]} {verdict["absent"]}')
