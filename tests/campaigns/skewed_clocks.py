# SPDX-License-Identifier: Apache-2.0
"""
Clocks that differ: each process of a recording has a trace of its own, and the clock of one of them is put forward or back
by up to an hour, as it is when the wall clock of a machine is set in the middle of a session.

The report has all events and callbacks, no time is negative, and it says by how much the clock was set: no message is taken
before it was published. When the trace comes from another machine instead, such a message is said.
"""

import json
import re
import shutil
import subprocess

from .campaign import Outcome

RUNS = 20
SKEWS = (1_000, 1_000_000, 20_000_000, 1_000_000_000, 30_000_000_000, 3_600_000_000_000)  # ns


def runs(place, random, count):
    place.new_run()
    place.launch(place.trace_tag(buffers_ust='pid', events_ust='ros2:*'),
                 '<node pkg="demo_nodes" exec="talker"/><node pkg="demo_nodes" exec="listener"/>',
                 '<timer period="4"><shutdown/></timer>')
    trace = place.path('trace')
    plain = report(place, trace)
    for number in range(count):
        skewed = place.path(f'skewed-{number}')
        shutil.copytree(trace, skewed)
        (skewed / 'verdict.json').unlink()
        name = random.choice(['talker', 'listener'])
        skew = random.choice((-1, 1)) * random.choice(SKEWS)
        yield judge(place, plain, skewed, name, skew, other_machine=random.random() < 0.5)


def report(place, directory):
    done = subprocess.run((place.program, 'report', '--json', directory), capture_output=True, text=True)
    return done.returncode, json.loads(done.stdout) if done.stdout else {}, done.stderr


def put(file, skew, other_machine):
    """Changes the clock in the metadata, which stay as long as they are: its offset, and the boot that it belongs to."""
    def later(match):
        return match[1] + str(int(match[2]) + skew).encode().rjust(len(match[2]), b'0')
    data = file.read_bytes()
    changed, count = re.subn(rb'(\boffset = )(\d{10,})', later, data)
    assert count == 1 and len(changed) == len(data), file
    if other_machine:
        changed, count = re.subn(rb'(clock \{[^}]*?uuid = ")[0-9a-f]{8}', rb'\g<1>01234567', changed)
        assert count == 1 and len(changed) == len(data), file
    file.write_bytes(changed)


def negative_times(value, path=''):
    if isinstance(value, dict):
        for key, inner in value.items():
            yield from negative_times(inner, f'{path}.{key}')
    elif isinstance(value, list):
        for inner in value:
            yield from negative_times(inner, path + '[]')
    elif isinstance(value, (int, float)) and not isinstance(value, bool) and value < 0 and 'offset' not in path:
        yield f'{path}: {value}'


def judge(place, plain, skewed, name, skew, other_machine):
    for file in skewed.glob(f'ust/pid/{name}-*/**/metadata'):
        put(file, skew, other_machine)
    code, seen, errors = report(place, skewed)
    outcome = Outcome(f'{name} by {skew / 1e9:g} s' + (', another machine' if other_machine else ''))
    if code != plain[0] or not seen:
        outcome.wrong.append(f'{name} by {skew} ns: exit code {code}: {errors}')
        return outcome
    for sentence in negative_times(seen):
        outcome.wrong.append(f'{name} by {skew} ns: {sentence}')
    if seen['events'] != plain[1]['events']:
        outcome.wrong.append(f'{name} by {skew} ns: {seen["events"]} events, not {plain[1]["events"]}')
    for table, fields in (('callbacks', ('node', 'symbol', 'owner')), ('subscriptions', ('node', 'topic', 'received', 'lost'))):
        rows = [sorted([row.get(field) for field in fields] for row in result[table]) for result in (plain[1], seen)]
        if rows[0] != rows[1]:
            outcome.wrong.append(f'{name} by {skew} ns: other {table}: {rows}')
    before = (skew > 0) == (name == 'talker')
    early = sum(topic['early'] for topic in seen['topics'])
    if not other_machine:
        was_set = f'was set while it was recorded, by {abs(skew) / 1e9:.3f} s'
        if abs(skew) >= 20_000_000 and not any(was_set in clock for clock in seen['clocks']):
            outcome.wrong.append(f'{name} by {skew} ns: not said: {seen["clocks"]}')
        if early and abs(skew) >= 20_000_000:
            outcome.wrong.append(f'{name} by {skew} ns: {early} messages are taken before they are published')
        return outcome
    if before and abs(skew) >= 1_000_000_000 and early == 0:
        outcome.wrong.append(f'{name} by {skew} ns: messages are taken before they are published, and nothing is said')
    return outcome
