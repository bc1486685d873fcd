# SPDX-License-Identifier: Apache-2.0
"""What a trace says, computed from what babeltrace2 prints of it, with nothing of the reader and the analysis of this project."""

import collections
import re
import subprocess

from rows_truth import Rows

LINE = re.compile(r'\[(\d+)\.(\d{9})\] .*? (ros2(?:_ext)?:\w+): (.*)')
OTHER = re.compile(r'\[(\d+)\.(\d{9})\] .*? (\w+):\w+: ')
FIELD = re.compile(r'(\w+) = (?:"((?:[^"\\]|\\.)*)"|(-?(?:0x)?[0-9A-Fa-f]+)|(\[.*?\](?= \}|, \w+ = )))')


def events_of(trace):
    """(time, name, fields) of the events of ROS 2, in the order of time. An array is its text. Others have no name and no fields."""
    text = subprocess.run(['babeltrace2', '--clock-seconds', trace], check=True, stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL, text=True).stdout
    for line in text.splitlines():
        if match := LINE.match(line):
            fields = {}
            for name, string, number, array in FIELD.findall(match[4]):
                fields[name] = array or (int(number, 0) if number else string)
            yield int(match[1]) * 10**9 + int(match[2]), match[3].split(':')[1], fields
        elif (match := OTHER.match(line)) and match[3] != 'launch':
            yield int(match[1]) * 10**9 + int(match[2]), '', {'vpid': 0, 'vtid': 0}


def place_in(long, short):
    """Where the events of one list are in the other one."""
    what = [event[1:] for event in short]
    for place in range(len(long) - len(short) + 1):
        if [event[1:] for event in long[place:place + len(short)]] == what:
            return place
    raise AssertionError('two sessions have recorded different events of one thread')


def events_once(traces):
    """
    The events that several sessions have recorded of the same processes, each once, with its first time. Of a thread, a session
    has recorded all events or those of a part of the time.
    """
    threads = collections.defaultdict(list)
    for trace in traces:
        of_trace = collections.defaultdict(list)
        for event in events_of(trace):
            of_trace[event[2]['vpid'], event[2]['vtid']].append(event)
        for thread, events in of_trace.items():
            threads[thread].append(events)
    result = []
    for lists in threads.values():
        lists.sort(key=len, reverse=True)
        times = [event[0] for event in lists[0]]
        for other in lists[1:]:
            place = place_in(lists[0], other)
            for at, event in enumerate(other, place):
                times[at] = min(times[at], event[0])
        result += [(time, *event[1:]) for time, event in zip(times, lists[0])]
    return sorted(result, key=lambda event: event[0])


def outermost(runs):
    """How many of the runs of a thread, in the order of their ends, are no part of another one (docs/report.md, "Executors")."""
    count, earliest = 0, None  # begin among those that end later
    for begin, _ in reversed(runs):
        if earliest is None or begin < earliest:
            count, earliest = count + 1, begin
    return count


class Truth:
    """What the events of a trace say, each process for itself."""

    def __init__(self, events):
        self.durations = collections.defaultdict(list)  # by process and address of the callback
        self.begins = collections.defaultdict(list)
        self.instances = []  # process, address of the callback, begin, duration
        self.period = {}  # of callbacks of timers
        self.published = collections.Counter()  # by topic
        self.received = collections.Counter()
        self.ways = []  # topic, publication, take, begin of the callback; not within a process
        self.latencies = collections.defaultdict(list)
        self.requests = collections.Counter()  # by process and service
        self.responses = collections.Counter()
        self.waits = []  # process, thread, begin, end
        self.waited = collections.Counter()  # by process and thread
        self.callbacks_of = collections.Counter()
        self.states = []  # of lifecycle nodes: goals
        self.events = events = list(events)
        self.rows = Rows(events)
        self.read(events)

    def read(self, events):
        topic_of = {}  # by process and handle of rmw
        timers = {}
        subscription_of_object = {}
        topic_of_rcl = {}
        callback_topic = {}
        services = {}
        publications = {}  # topic and timestamp: time
        running = {}
        taken = {}
        waiting = {}
        answering = {}  # begin, by thread
        runs_of = collections.defaultdict(list)  # begin and end, by thread, in the order of the ends

        def take_ends(thread, callback=None):
            if thread in taken:
                topic, published, at = taken.pop(thread)
                if published is not None:
                    self.ways.append((topic, published, at, callback))

        for time, name, f in events:
            process = f['vpid']
            thread = process, f['vtid']
            if name in ('rcl_publisher_init', 'rcl_subscription_init'):
                kind = name.split('_')[1]
                topic_of[process, f[f'rmw_{kind}_handle']] = f['topic_name']
                topic_of_rcl[process, f[f'{kind}_handle']] = f['topic_name']
            elif name == 'rclcpp_subscription_init':
                subscription_of_object[process, f['subscription']] = topic_of_rcl.get((process, f['subscription_handle']))
            elif name == 'rclcpp_subscription_callback_added':
                callback_topic[process, f['callback']] = f['subscription']
            elif name == 'rcl_timer_init':
                timers[process, f['timer_handle']] = f['period']
            elif name == 'rclcpp_timer_callback_added':
                self.period[process, f['callback']] = timers[process, f['timer_handle']]
            elif name == 'rcl_client_init':
                services[process, f['rmw_client_handle']] = f['service_name']
            elif name == 'rmw_publish' and (topic := topic_of.get((process, f['rmw_publisher_handle']))):
                self.published[topic] += 1
                publications[topic, f['timestamp']] = time
            elif name == 'rmw_take':
                take_ends(thread)
                topic = topic_of.get((process, f['rmw_subscription_handle']))
                if topic and f['taken']:
                    self.received[topic] += 1
                    taken[thread] = topic, publications.get((topic, f['source_timestamp'])), time
            elif name == 'callback_start':
                callback = process, f['callback']
                self.begins[callback].append(time)
                self.end_run(running, (thread, f['callback']), None)
                running[thread, f['callback']] = time
                if thread in taken and not f['is_intra_process']:
                    topic, published, _ = taken[thread]
                    is_its_own = subscription_of_object.get((process, callback_topic.get(callback))) == topic
                    take_ends(thread, time if is_its_own else None)
                    if published and is_its_own:
                        self.latencies[topic].append(time - published)
            elif name == 'callback_end':
                begin = running.get((thread, f['callback']))
                if self.end_run(running, (thread, f['callback']), time):
                    runs_of[thread].append((begin, time))
            elif name == 'rclcpp_client_callback_start':
                answering[thread] = time
            elif name == 'rclcpp_client_callback_end':
                runs_of[thread].append((answering.pop(thread, time), time))
            elif name == 'rmw_send_request' and (process, f['rmw_client_handle']) in services:
                self.requests[process, services[process, f['rmw_client_handle']]] += 1
            elif name == 'rmw_take_response' and f['taken'] and (process, f['rmw_client_handle']) in services:
                self.responses[process, services[process, f['rmw_client_handle']]] += 1
            elif name == 'rclcpp_executor_wait_for_work':
                take_ends(thread)
                waiting[thread] = time
            elif name == 'rclcpp_executor_get_next_ready' and thread in waiting:
                self.waits.append((*thread, waiting[thread], time))
                self.waited[thread] += time - waiting.pop(thread)
            elif name == 'rcl_lifecycle_transition':
                self.states.append((time, f['goal_label']))
        for thread in list(taken):
            take_ends(thread)
        for run in list(running):
            self.end_run(running, run, None)
        for thread, runs in runs_of.items():
            self.callbacks_of[thread] = outermost(runs)

    def end_run(self, running, run, time):
        (process, _), callback = run
        begin = running.pop(run, None)
        if begin is None:
            return False
        self.instances.append((process, callback, begin, None if time is None else time - begin))
        if time is not None:
            self.durations[process, callback].append(time - begin)
        return True
