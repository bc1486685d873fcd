# SPDX-License-Identifier: Apache-2.0
"""
What different sessions add to a message: half of the tracepoints, context fields, the network, live reading, the kernel.

Messages of 1 KiB go at 1,000 Hz from one process to another. The sessions take turns with each other and with none. The floor
of each is what the nine tracepoints of a message's way cost with the same session, called at the same pace with nothing between
them but the copy of a message.
"""

import struct

from ..bootstrap import hierarchical, median, middle_mean, of_samples
from ..kernel import KernelRecorderError
from ..presets import SIZES
from ..results import figure_of
from ..session import DEFAULT, PAPER, Session, SessionError, SessionPlan
from ..worker import Exchange, Worker

GROUP = 'what a session adds to a message'
SIZE_INDEX, RATE = 0, 1000
BATCH_SECONDS = 0.25

# Those that tell when a message was published and when its callback ran.
HALF = ('ros2:rclcpp_publish', 'ros2:rmw_publish', 'ros2:rmw_take', 'ros2:callback_start', 'ros2:callback_end')
KERNEL = ('sched_switch', 'sched_wakeup', 'sched_waking', 'irq_handler_entry', 'irq_handler_exit')

SESSIONS = (
    ('all events, no context fields, as in the paper', PAPER),
    ('all events, three context fields, the default', DEFAULT),
    ('five events: publications, takes, callbacks', SessionPlan('half', events=HALF)),
    ('all events, over the network to a relay daemon', SessionPlan('network', output='network')),
    ('all events, live, over the network', SessionPlan('live', output='live')),
    ("all events, and the kernel's scheduler and interrupts", SessionPlan('kernel', kernel_events=KERNEL)),
)


def _open(bench, result):
    """The sessions that can be made here."""
    sessions = []
    for name, plan in SESSIONS:
        try:
            if plan.output != 'disk':
                bench.place.start_relay()
            sessions.append((name, Session(plan, bench.place.directory, bench.kernel_recorder)))
        except (SessionError, KernelRecorderError, OSError) as error:
            result['left_out'].append({'what': name, 'reason': str(error)})
    return sessions


def measure(bench, result):
    sessions = _open(bench, result)
    try:
        _measure(bench, result, sessions)
    finally:
        for _, session in sessions:
            session.close()


def _cost_of_tracepoints(bench, session):
    """Microseconds for the nine tracepoints of a message, called at the pace of the messages."""
    with Worker(bench.program('latency_tracepoints'), '', 0, bench.tuning) as worker:
        session.start()
        worker.send(struct.pack('=qQ', round(1e9 / RATE), SIZES[SIZE_INDEX]))
        _, at_pace = struct.unpack('=dd', worker.receive(16))
        session.stop()
        return at_pace


def _note(session, lost):
    notes = [f'{lost} events lost'] if lost else []
    if session.through_tracefs:
        notes.append("the kernel's events through tracefs")
    return ', '.join(notes) or None


def _measure(bench, result, sessions):
    messages = max(2, round(BATCH_SECONDS * bench.preset.scale * RATE))
    groups = {name: [] for name, _ in sessions}
    tracepoints = {name: [] for name, _ in sessions}
    lost = dict.fromkeys(groups, 0)
    for _ in range(bench.preset.repetitions):
        with Exchange(bench.program('latency_stack'), 2, bench.tuning) as exchange:
            def batch():
                exchange.run(SIZE_INDEX, bench.preset.warm_up_messages, RATE)
                return median(exchange.run(SIZE_INDEX, messages, RATE)) / 1e3

            exchange.run(SIZE_INDEX, messages, RATE)
            for name, session in sessions:
                groups[name].append([[]])
                lost[name] -= session.lost_events()
            for turn in range(2):
                for name, session in sessions if turn == 0 else reversed(sessions):
                    before = batch()
                    session.start()
                    traced = batch()
                    session.stop()
                    after = batch()
                    groups[name][-1][0].append(traced - (before + after) / 2)
            for name, session in sessions:
                lost[name] += session.lost_events()
        for name, session in sessions:
            tracepoints[name].append(_cost_of_tracepoints(bench, session))
    for name, session in sessions:
        result['figures'].append(figure_of(
            GROUP, name, 'us', hierarchical(groups[name], lambda strata: middle_mean(strata[0])), 2 * len(groups[name]),
            floor=of_samples(tracepoints[name]), floor_name="a message's tracepoints alone",
            note=_note(session, lost[name])))
