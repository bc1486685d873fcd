# SPDX-License-Identifier: Apache-2.0
"""
Measures how fast Python reads a trace: iterate_trace.py TRACE [EVENTS FOR BT2].

The module launch_trace stands beside bt2, babeltrace2's own module (Debian: python3-bt2), where that is installed. Each
reads the same fields. bt2 gets only the first events, because it is slow. The times are processor time.
"""

import itertools
import sys
import time

import launch_trace


def measure(name, read, trace, floor=None):
    best = float('inf')
    for _ in range(3):
        begin = time.process_time()
        events = read(trace)
        best = min(best, (time.process_time() - begin) / events)
    ratio = f"{floor / best:6.1f} times bt2's speed" if floor else ''
    print(f'{name:<44} {1 / best / 1e6:8.3f} M events/s   {ratio}')
    return best


def our_events(trace):
    count = 0
    for _ in launch_trace.Trace(trace):
        count += 1
    return count


def our_fields(trace):
    count = 0
    for event in launch_trace.Trace(trace):
        event.name, event.time_ns, event.vpid
        for field in event:
            event[field]
        count += 1
    return count


def our_columns(trace):
    columns = launch_trace.Trace(trace).columns('ros2:callback_start', ['time_ns', 'vtid', 'callback', 'is_intra_process'])
    return len(columns['callback']) * per_callback_start


def first_messages(trace):
    import bt2
    return itertools.islice((message for message in bt2.TraceCollectionMessageIterator(trace)
                             if type(message) is bt2._EventMessageConst), bt2_events)


def bt2_iteration(trace):
    count = 0
    for _ in first_messages(trace):
        count += 1
    return count


def bt2_fields(trace):
    count = 0
    for message in first_messages(trace):
        event = message.event
        event.name, message.default_clock_snapshot.ns_from_origin, event['vpid']
        for field in event.payload_field:
            event.payload_field[field]
        count += 1
    return count


if __name__ == '__main__':
    trace = sys.argv[1]
    bt2_events = int(sys.argv[2]) if len(sys.argv) > 2 else 50_000
    all_events = our_events(trace)
    starts = launch_trace.Trace(trace).columns('ros2:callback_start', ['time_ns'])['time_ns']
    per_callback_start = all_events / len(starts)  # all events are read for the columns of one
    floor_of_iteration = floor_of_fields = None
    try:
        import bt2  # noqa: F401
    except ImportError:
        print('bt2 is not installed (Debian: python3-bt2)')
    else:
        floor_of_iteration = measure('bt2, events', bt2_iteration, trace)
        floor_of_fields = measure('bt2, name, time, vpid, every field', bt2_fields, trace)
    measure('launch_trace, events with all fields', our_events, trace, floor_of_iteration)
    measure('launch_trace, name, time, vpid, every field', our_fields, trace, floor_of_fields)
    measure('launch_trace, columns of one event', our_columns, trace, floor_of_fields)
