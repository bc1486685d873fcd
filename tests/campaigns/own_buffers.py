# SPDX-License-Identifier: Apache-2.0
"""
A process with buffers of its own crashes while its other threads fire, or ends; its packets are written in short intervals.

The trace holds the last events that every thread fired on every processor, by the program's own record, or its verdict
is not complete and names the processor that lacks some. One whose program has ended is complete. Some programs do not count
their events, and some are executed by a shell that has had buffers, too.
"""

import re

from . import crashes
from .campaign import Outcome

RUNS = 50

COMMANDS = {
    'counted': '{}',
    'not counted': 'env -u LD_PRELOAD {}',
    'of a shell': "env LD_PRELOAD=liblttng-ust.so.1 sh -c 'sleep 0.1; exec {}'",
}


def run(place, random):
    place.new_run()
    kind = random.choice(list(COMMANDS))
    timer = random.choice([20_000, 200_000, 5_000_000])
    ending = random.choice([{'crash': random.randint(30_000, 300_000)}, {'events': 3000, 'burst': 50, 'pause': 3000}])
    tag = place.app_tag(threads=random.choice([1, 2, 4]), bytes=random.choice([8, 40]),
                        attributes='allowed-exit-codes="SIGSEGV"', **ending)
    tag = re.sub('cmd="(.*?)"', lambda match: f'cmd="{COMMANDS[kind].format(match[1])}"', tag)
    launch = place.launch(place.trace_tag(buffers_ust='pid', switch_timer_ust=timer, subbuffer_size_ust=2 ** 24,
                                          subbuffer_count_ust=8), tag)
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
    if 'events' in ending and not verdict['complete'] and not verdict['discarded_events']:
        outcome.wrong.append(f'ended, but not complete: {verdict["damage"]}')
    outcome.result = f"{kind}, {outcome.result.split(',')[0]}"
    outcome.numbers['events'] = len(recorded.events)
    return outcome
