# SPDX-License-Identifier: Apache-2.0
"""
`launch report --live` of a session in which fifty nodes come and go. At its end the view says what `launch report` says of
the trace that the relay daemon has written.
"""

import json
import subprocess
import time

from .campaign import Outcome

RUNS = 10
NODES = 50
AT_ONCE = 12


def run(place, random):
    place.new_run()
    place.start_relay()
    log = open(place.path('live.log'), 'w', encoding='utf-8')
    out = open(place.path('live.json'), 'w', encoding='utf-8')
    view = place.start(place.program, 'report', '--live', 'seen', '--json', '--interval=0.2', stdout=out, stderr=log)
    _wait_for(place, 'waiting for the session')
    begin = time.monotonic()
    started = subprocess.run((place.program, 'trace', 'start', 'seen', '--live-timer', '50000'), capture_output=True,
                             text=True)
    outcome = Outcome('the same as the recorded trace')
    if started.returncode != 0:
        outcome.wrong.append(started.stderr)
        return outcome
    _wait_for(place, 'attached to the session')
    beats = _come_and_go(place, random)
    stopped = subprocess.run((place.program, 'trace', 'stop', 'seen'), capture_output=True, text=True)
    try:
        code = view.wait(60)
    except subprocess.TimeoutExpired:
        view.kill()
        code = view.wait()
        outcome.wrong.append('the view did not end with the session')
    log.close()
    out.close()
    outcome.numbers.update({'took s': time.monotonic() - begin, 'messages': beats})
    recorded = subprocess.run((place.program, 'report', '--json', place.path('relayed')), capture_output=True, text=True)
    said = place.path('live.log').read_text(encoding='utf-8')
    try:
        seen, expected = json.loads(place.path('live.json').read_text(encoding='utf-8')), json.loads(recorded.stdout)
    except ValueError:
        outcome.wrong.append(f'no report: {said[-300:]} {recorded.stderr}')
        outcome.result = 'no report'
        return outcome
    seen['directory'] = expected['directory']
    if code != 0 or stopped.returncode != 0:
        outcome.wrong.append(f'the view ended with {code}, the session with {stopped.returncode}: {said[-300:]}')
    if seen != expected:
        outcome.result = 'other than the recorded trace'
        different = [key for key in expected if seen.get(key) != expected[key]]
        outcome.wrong.append(f'the view differs from the report of the trace in {different}')
    messages = sum(subscription['delivered'] for subscription in expected['subscriptions'])
    if len(expected['processes']) != NODES:
        outcome.wrong.append(f'the report has {len(expected["processes"])} processes of {NODES}')
    if messages != beats:
        outcome.wrong.append(f'{beats} messages were sent, the report has {messages}')
    return outcome


def _wait_for(place, text):
    until = time.monotonic() + 60
    while text not in place.path('live.log').read_text(encoding='utf-8') and time.monotonic() < until:
        time.sleep(0.02)


def _come_and_go(place, random):
    """Fifty nodes, some of them at once. Returns how many messages they sent and took."""
    worker = place.build / 'tests/e2e/tracing/live_report_worker'
    nodes, beats = [], 0
    for started in range(NODES):
        nodes.append(place.start(worker, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1))
        while len(nodes) >= AT_ONCE or (started == NODES - 1 and nodes):
            node = random.choice(nodes)
            count = random.choice([1, 20, 200])
            node.stdin.write(f'{count}\n')
            node.stdout.readline()
            beats += count
            if random.random() < 0.5:
                node.stdin.close()
                node.wait()
                nodes.remove(node)
    return beats
