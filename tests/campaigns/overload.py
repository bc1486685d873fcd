# SPDX-License-Identifier: Apache-2.0
"""
Several threads and programs fire more than the buffers take. The verdict's lost events are what was fired by the
programs' own records, less what babeltrace2 reads.
"""

from .campaign import Outcome

RUNS = 50
TOLERANCE = 3


def run(place, random):
    place.new_run()
    programs, threads = random.choice([(1, 1), (1, 3), (2, 1), (2, 2), (3, 1)])
    events = random.choice([50_000, 200_000, 400_000]) // (programs * threads)
    launch = place.launch(
        place.trace_tag(subbuffer_size_ust=random.choice([4096, 16384, 131072]), subbuffer_count_ust=random.choice([2, 4]),
                        read_timer_ust=random.choice([0, 1000, 50_000, 100_000]),
                        switch_timer_ust=random.choice([0, 20_000, 5_000_000])),
        *(place.app_tag(number, threads=threads, events=events, bytes=random.choice([8, 100]),
                        burst=random.choice([0, 500, 5000]), pause=1000) for number in range(programs)))
    outcome = Outcome('exact', numbers={'launch took s': launch.seconds})
    verdict = place.verdict(place.path('trace'))
    if launch.code is None or verdict is None:
        outcome.result = 'no verdict'
        outcome.wrong.append(f'no verdict, exit code {launch.code}: {launch.output[-500:]}')
        return outcome
    recorded = place.read(place.path('trace'))
    fired = sum(record.done for number in range(programs) for record in place.counts(number).values())
    lost = fired - len(recorded.events)
    off = verdict['discarded_events'] - lost
    outcome.numbers.update({'fired': fired, 'lost': lost, 'off by': abs(off)})
    if not recorded.readable:
        outcome.wrong.append(f'babeltrace2: {recorded.error}')
    if abs(off) > TOLERANCE:
        outcome.wrong.append(f'fired {fired}, recorded {len(recorded.events)}, so lost {lost}, '
                             f'but the verdict says {verdict["discarded_events"]}')
        outcome.result = 'other sum'
    elif off != 0:
        outcome.result = 'within 3'
    if verdict['complete'] != (lost == 0):
        outcome.wrong.append(f'complete: {verdict["complete"]}, but lost {lost}')
    if fired != programs * threads * events:
        outcome.wrong.append(f'fired {fired}, not {programs * threads * events}')
    return outcome
