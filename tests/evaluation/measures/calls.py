# SPDX-License-Identifier: Apache-2.0
"""
Services and actions: from the request to the response, and from the goal to its result, between two processes.

The floor of a service is a request and a reply on bare Fast DDS, with a wait set on both sides. An action asks its server
twice, for the goal and for the result: its floor is two of these round trips.
"""

from ..results import figure_of
from ..worker import Caller
from . import turns
from .stack import OWN

GROUP = 'services and actions'
BATCH_SECONDS = 0.3
BARE = 'bare Fast DDS'
# Name, role of the client, role of the server, calls a second, round trips.
CALLS = (('service, request to response', 'service_client', 'service_server', 1000, 1),
         ('action, goal to result', 'action_client', 'action_server', 500, 2))


def _contestants(bench, client, server):
    def caller(name, program, client, server, environment=None):
        return turns.Contestant(name, lambda variables: Caller(program, client, server, bench.tuning, variables),
                                environment or {})

    yield caller(OWN, bench.program('latency_calls'), client, server)
    yield caller(BARE, bench.program('latency_bare_calls'), 'client', 'server')
    if bench.ros2:
        yield caller(bench.ros2.name, bench.ros2.program('latency_calls'), client, server, bench.ros2.environment)


def measure(bench, result):
    for what, client, server, rate, round_trips in CALLS:
        medians = turns.measure(bench.preset, list(_contestants(bench, client, server)), [turns.Condition(0, rate)],
                                BATCH_SECONDS)
        bare = medians.pop(BARE)
        floor = bare.estimate(0).scaled(round_trips)
        for name, one in medians.items():
            result['figures'].append(figure_of(
                GROUP, f'{name}: {what}, {rate} Hz, median', 'us', one.estimate(0), one.batches, floor=floor,
                floor_name='a round trip on bare Fast DDS' if round_trips == 1 else f'{round_trips} round trips on bare Fast DDS'))
