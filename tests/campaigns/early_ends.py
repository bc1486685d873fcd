# SPDX-License-Identifier: Apache-2.0
"""
Processes with buffers of their own end very early: before LTTng has registered them, or just after. babeltrace2 reads
what is left of each trace, and all that the other processes have fired is in it.

Each run is one early end; a launch has several of them.
"""

from .campaign import Outcome

RUNS = 200
ENDS_OF_A_LAUNCH = 10


def runs(place, random, count):
    """Launches, until there were so many early ends. Yields an outcome for each."""
    left = count
    while left > 0:
        ends = min(left, ENDS_OF_A_LAUNCH)
        yield from [_launch(place, random, ends)] + [Outcome('an early end') for _ in range(ends - 1)]
        left -= ends


def _launch(place, random, ends):
    place.new_run()
    early = []
    for number in range(1, ends + 1):
        # Those that wait for the registration at their start have not come to main() yet when they are killed.
        milliseconds = random.choice([0, 1, 2, 3, 5, 8, 12, 20, 30])
        word = random.choice(['KILL', 'KILL', 'TERM', 'end'])
        timeout = random.choice(['0', '-1'])
        app = f"{place.firing_app} {place.path(f'counts-{number}')} events={random.choice([1, 100])}"
        shell = (f'exec {app}' if word == 'end' else
                 f'{app} &amp; sleep {milliseconds / 1000}; kill -{word} $!; wait $! 2>/dev/null; true')
        early.append(f'<executable name="early_{number}" cmd="{shell}" shell="true" allowed-exit-codes="SIGKILL, SIGTERM">'
                     f'<env name="LTTNG_UST_REGISTER_TIMEOUT" value="{timeout}"/></executable>')
    launch = place.launch(place.trace_tag(buffers_ust='pid', subbuffer_size_ust=4096),
                          place.app_tag(0, threads=1, events=300, burst=10, pause=20_000), *early)
    outcome = Outcome('an early end', numbers={'launch took s': launch.seconds})
    verdict = place.verdict(place.path('trace'))
    if launch.code is None or verdict is None:
        outcome.wrong.append(f'no verdict, exit code {launch.code}: {launch.output[-500:]}')
        return outcome
    recorded = place.read(place.path('trace'))
    outcome.numbers['events'] = len(recorded.events)
    outcome.numbers['put aside'] = len(list(place.path('trace').glob('unreadable/*')))
    if not recorded.readable:
        outcome.wrong.append(f'babeltrace2: {recorded.error}')
    fired = sum(record.done for record in place.counts(0).values())
    steady = sum(1 for *_, number, _ in recorded.events if number > 100)
    if fired != 300 or steady != 200:
        outcome.wrong.append(f'of the steady process {fired} were fired, {steady} of its last 200 are there')
    recorded_by_all = len(recorded.events)
    fired_by_all = sum(record.done for number in range(ends + 1) for record in place.counts(number).values())
    if recorded_by_all > fired_by_all + ends:
        outcome.wrong.append(f'recorded {recorded_by_all} of {fired_by_all}')
    return outcome
