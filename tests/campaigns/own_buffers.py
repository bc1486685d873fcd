# SPDX-License-Identifier: Apache-2.0
"""
A process with buffers of its own crashes while its other threads fire; its packets are written in short intervals.

The trace holds the last events that every thread fired on every processor, by the program's own record, or its verdict
is not complete and names the processor that lacks some. Every second program does not count its events.
"""

from . import crashes
from .campaign import Outcome

RUNS = 50


def run(place, random):
    place.new_run()
    counts = random.choice([True, False])
    timer = random.choice([20_000, 200_000, 5_000_000])
    attributes = 'allowed-exit-codes="SIGSEGV"'
    tag = place.app_tag(threads=random.choice([1, 2, 4]), bytes=random.choice([8, 40]),
                        crash=random.randint(30_000, 300_000), attributes=attributes)
    if not counts:
        tag = tag.replace('cmd="', 'cmd="env -u LD_PRELOAD ')
    launch = place.launch(place.trace_tag(buffers_ust='pid', switch_timer_ust=timer, subbuffer_size_ust=2 ** 24, subbuffer_count_ust=8), tag)
    outcome = Outcome('', numbers={'launch took s': launch.seconds})
    verdict = place.verdict(place.path('trace'))
    if launch.code is None or verdict is None:
        outcome.wrong.append(f'verdict: {verdict is not None}, exit code {launch.code}: {launch.output[-300:]}')
        outcome.result = 'no verdict'
        return outcome
    recorded = place.read(place.path('trace'))
    if not recorded.readable:
        outcome.wrong.append(f'babeltrace2: {recorded.error}')
    crashes.judge(outcome, verdict, place.counts(), recorded)
    outcome.result = ('counted, ' if counts else 'not counted, ') + outcome.result.split(',')[0]
    outcome.numbers['events'] = len(recorded.events)
    return outcome
