# SPDX-License-Identifier: Apache-2.0
"""
Random configurations of a session: buffers, counts, modes, timers, channels, contexts, sizes of files, overwriting.

What the verdict says is held against three others: the headers of the packets, babeltrace2, and the programs' own counts.
"""

import json
import subprocess

from .campaign import Outcome
from .crashes import lacking
from .packet_headers import streams_in

RUNS = 100
CONTEXTS = ('procname', 'vpid', 'vtid', 'pthread_id', 'ip', 'vpid vtid', 'procname vpid vtid')


def choose(random):
    """Attributes of the <trace>, items in it, and what the programs fire."""
    size = random.choice([4096, 8192, 16384, 65536, 262144])
    attributes = {'subbuffer_size_ust': size, 'subbuffer_count_ust': random.choice([2, 4, 8]),
                  'buffers_ust': random.choice(['uid', 'pid']),
                  'read_timer_ust': random.choice([0, 1000, 50_000]),
                  'switch_timer_ust': random.choice([0, 10_000, 1_000_000]),
                  'context_fields': random.choice(CONTEXTS)}
    snapshot = random.random() < 0.2
    if snapshot:
        attributes['snapshot_on_crash'] = 'true'
        attributes['context_fields'] = 'vpid'
    else:
        attributes['overwrite_ust'] = random.choice(['true', 'false'])
        if random.random() < 0.4:
            attributes['tracefile_size'] = size * random.choice([1, 2, 4])
            attributes['tracefile_count'] = random.choice([0, 2, 3])
        if random.random() < 0.2:
            attributes['append_timestamp'] = 'true'
    channels = {'ros2': ('even', 'odd')}
    items = ''
    if not snapshot and random.random() < 0.4:
        channels = {'ros2': ('even',), 'second_1': ('odd',)}
        attributes['events_ust'] = 'campaign:even'
        items = (f'<channel name="second_1" events-ust="campaign:odd" subbuffer-size="{random.choice([4096, 32768])}" '
                 f'overwrite="{random.choice(["true", "false"])}"/>')
    programs = [{'threads': random.choice([1, 2, 3]), 'events': random.choice([20, 400, 4000, 20_000]),
                 'bytes': random.choice([0, 8, 30, 200]), 'burst': random.choice([0, 50, 500]), 'pause': 2000}
                for _ in range(random.choice([1, 2, 3]))]
    return attributes, items, channels, programs, snapshot


def run(place, random):
    place.new_run()
    attributes, items, channels, programs, snapshot = choose(random)
    tags = [place.app_tag(number, **program) for number, program in enumerate(programs)]
    if snapshot:
        tags[0] = place.app_tag(0, **programs[0], crash=random.randint(100_000, 300_000),
                                attributes='allowed-exit-codes="SIGSEGV"')
    launch = place.launch(place.trace_tag(items=items, **attributes), *tags)
    kind = 'snapshot' if snapshot else 'channels' if len(channels) > 1 else attributes['buffers_ust']
    outcome = Outcome(kind, numbers={'launch took s': launch.seconds})
    found = sorted(place.path().glob('trace*/snapshot-*' if snapshot else 'trace*'))
    verdict = place.verdict(found[-1]) if found else None
    if launch.code is None or verdict is None:
        outcome.wrong.append(f'no verdict, exit code {launch.code}: {launch.output[-800:]}')
        return outcome
    fired = [place.counts(number) for number in range(len(programs))]
    judge(outcome, place, found[-1], verdict, channels, fired, snapshot)
    outcome.wrong = [f'{sentence}; {attributes} {items} {programs}' for sentence in outcome.wrong]
    return outcome


def judge(outcome, place, directory, verdict, channels, fired, snapshot):
    recorded = place.read(directory)
    has_streams = any(directory.glob('**/ust/**/*_*'))  # else babeltrace2 finds nothing to read
    if not recorded.readable and has_streams:
        outcome.wrong.append(f'babeltrace2: {recorded.error}')
    streams = streams_in(directory, channels)
    hold_against_headers(outcome, verdict, streams, snapshot)
    discarded = sum(stream.discarded for stream in streams)
    lost_packets = sum(stream.lost_packets for stream in streams)
    earlier = sum(stream.earlier_packets for stream in streams)
    if not recorded.wrapped:
        # babeltrace2 has no number for what the very first packet of a stream tells, and follows totals that go back.
        first = sum(stream.packets[0].discarded for stream in streams if stream.packets and not stream.earlier_packets)
        if abs(recorded.discarded + first - discarded) > 0 and _only_climb(streams):
            outcome.wrong.append(f'babeltrace2 counts {recorded.discarded} discarded events and {first} in first packets, '
                                 f'the headers {discarded}')
    if recorded.lost_packets != lost_packets:
        outcome.wrong.append(f'babeltrace2 counts {recorded.lost_packets} lost packets, the headers {lost_packets}')
    fired_number = sum(record.done for records in fired for record in records.values())
    number = len(recorded.events)
    outcome.numbers.update({'fired': fired_number, 'recorded': number})
    if snapshot:
        lacks = lacking(fired[0], recorded, place.started()[0])  # the others went on
        if lacks and verdict['complete']:
            outcome.wrong.append(f'complete, but {list(lacks.values())}')
        return
    missing = fired_number - number
    unfinished = any(channel.get('unwritten') for channel in verdict['channels'])  # what it lacks has no number
    if lost_packets == 0 and earlier == 0 and not unfinished and abs(missing - verdict['discarded_events']) > 3:
        outcome.wrong.append(f'fired {fired_number}, recorded {number}, but the verdict says '
                             f'{verdict["discarded_events"]} lost')
    if verdict['complete'] != (missing == 0):
        outcome.wrong.append(f'complete: {verdict["complete"]} ({verdict["damage"]} {verdict["absent"]}), but '
                             f'{missing} events are missing')
    report = json.loads(subprocess.run((place.program, 'report', '--json', directory), capture_output=True,
                                       text=True).stdout or '{}')
    counted = report.get('trace', {}).get('events', report.get('events'))
    if isinstance(counted, int) and counted != number + recorded.others:
        outcome.wrong.append(f'the report counts {counted} events, babeltrace2 {number + recorded.others}')


def _only_climb(streams):
    totals = [[packet.discarded for packet in stream.packets] for stream in streams]
    return all(total == sorted(total) for total in totals)


def hold_against_headers(outcome, verdict, streams, snapshot):
    if snapshot:
        said = {'': verdict}
        sums = {'': streams}
    else:
        said = {channel['channel']: channel for channel in verdict['channels']}
        sums = {name: [stream for stream in streams if stream.channel == name] for name in said}
    for name, channel in said.items():
        only_daemon = channel.get('only_daemon', {'discarded_events': 0, 'lost_packets': 0})
        for field, value in (('discarded_events', sum(stream.discarded for stream in sums[name])),
                             ('lost_packets', sum(stream.lost_packets for stream in sums[name]))):
            if channel[field] - only_daemon[field] != value:
                outcome.wrong.append(f'{name}: {field} {channel[field]} ({only_daemon[field]} of the daemon alone), '
                                     f'the headers say {value}')
        if snapshot:
            continue
        size = sum(packet.bytes for stream in sums[name] for packet in stream.packets)
        if channel['bytes'] != size:
            outcome.wrong.append(f'{name}: {channel["bytes"]} bytes, the headers say {size}')
        before = channel.get('before_first_packet', {'packets': 0})['packets']
        earlier = sum(stream.earlier_packets for stream in sums[name])
        if before != earlier:
            outcome.wrong.append(f'{name}: {before} packets before the first, the headers say {earlier}')
