# SPDX-License-Identifier: Apache-2.0
"""
What a trace says of machines, processes, threads, memory and starts, from all events that babeltrace2 prints, whatever provider
they have, with nothing of the reader and the analysis of this project.
"""

import collections
import re
import signal
import subprocess

LINE = re.compile(r'\[(\d+)\.(\d{9})\] \([^)]*\) ([^\s:]+)\S* (\w+):(\w+): \{[^}]*\}, \{(.*?)\}, \{(.*)\}$')
NAME = re.compile(r'procname = "((?:[^"\\]|\\.)*)"')
NUMBER = re.compile(r'(\w+) = (-?(?:0x)?[0-9A-Fa-f]+)')
LOST = re.compile(r'Tracer (?:discarded|lost) (\d+) (?:trace )?(event|packet)s? .* within stream "([^"]*)"')
TEXT = re.compile(r'(\w+) = "((?:[^"\\]|\\.)*)"')
ASKING = ('malloc', 'calloc', 'realloc', 'memalign', 'posix_memalign')


def text_of(trace):
    return subprocess.run(['babeltrace2', '--clock-seconds', trace], check=True, capture_output=True, text=True)


def lost_of(trace):
    """
    Events that were dropped and packets that were overwritten, as far as they were counted, of all streams.

    Sometimes the tracer's total of a stream is smaller in a packet than in the one before it. So the highest total counts.
    """
    now, highest = collections.Counter(), collections.Counter()
    for count, what, stream in LOST.findall(text_of(trace).stderr):
        now[what, stream] += int(count) - (1 << 64 if int(count) >> 63 else 0)
        highest[what, stream] = max(highest[what, stream], now[what, stream])
    return tuple(sum(total for (lost, _), total in highest.items() if lost == what) for what in ('event', 'packet'))


def everything_of(trace):
    """(time, host, provider, event, name of the thread, numbers of the context and of the fields, text) in the order of time."""
    for line in text_of(trace).stdout.splitlines():
        match = LINE.match(line)
        assert match, line
        seconds, nanoseconds, host, provider, event, context, fields = match.groups()
        name = NAME.search(context)
        numbers = {key: int(value, 0) for key, value in NUMBER.findall(NAME.sub('', context) + ' ' + fields)}
        yield int(seconds) * 10**9 + int(nanoseconds), host, provider, event, name and name[1], numbers, fields


class Starts:
    """What the launcher's events tell of each process that it has started."""

    def __init__(self):
        self.spawned, self.executed, self.processes, self.first = {}, {}, {}, collections.defaultdict(dict)
        self.node_of_rcl, self.topic_of = {}, {}
        self.zeros = []  # of the monotonic clock, at the earliest
        self.zeros_of = {}  # of the monotonic clock of each launcher
        self.events = []  # (launcher, time of its monotonic clock, kind, subject, what, file, line)

    def of_launcher(self, time, event, numbers, fields):
        texts = dict(TEXT.findall(fields))
        if numbers.get('time'):
            zero = time - numbers['time']
            self.zeros.append(zero)
            self.zeros_of[numbers['vpid']] = min(zero, self.zeros_of.get(numbers['vpid'], zero))
        code = numbers.get('exit_code')
        ended = f'exit code {code}' if code is not None and code >= 0 else code and signal.Signals(-code).name
        subject, what = {'condition': (texts.get('condition'), texts.get('change')), 'scheduling': (texts.get('process'), texts.get('change')),
                         'signal': (texts.get('process'), event == 'signal' and signal.Signals(numbers['signal']).name),
                         'exit': (texts.get('process'), ended), 'respawn': (texts.get('process'), ended),
                         'cut': (texts.get('event_class'), texts.get('events'))}.get(event, (None, None))
        if subject is not None:
            self.events.append((numbers['vpid'], numbers['time'], event, subject, what or None, texts.get('file') or None, numbers.get('line', 0)))
        if event == 'spawn':
            self.spawned[texts['file'], numbers['line'], texts['process']] = numbers['time']
        elif event == 'exec':
            name, place = texts['process'].rpartition('-')[0], (texts['file'], numbers['line'])
            self.executed[numbers['pid']] = numbers['time']
            self.processes[numbers['pid']] = texts['process'], *place, numbers['time'] - self.spawned[(*place, name)]

    def of_process(self, time, process, event, numbers, fields):
        first = self.first[process]
        if event == 'rcl_init':
            first.setdefault('init', time)
        elif event == 'rcl_node_init':
            first.setdefault('node', time)
        elif event.startswith('rclcpp_executor_') and 'node' in first:
            first.setdefault('ready', time)
        elif event == 'callback_start':
            first.setdefault('callback', time)
        elif event == 'rcl_publisher_init':
            topic = dict(TEXT.findall(fields))['topic_name']
            self.topic_of[process, numbers['rmw_publisher_handle']] = self.topic_of[process, numbers['publisher_handle']] = topic
        elif event in ('rmw_publish', 'rclcpp_intra_publish'):
            handle = numbers['rmw_publisher_handle' if event == 'rmw_publish' else 'publisher_handle']
            if self.topic_of.get((process, handle)) not in (None, '/rosout', '/parameter_events'):
                first.setdefault('publication', time)

    def event_rows(self):
        return [(self.zeros_of[launcher] + time, *told) for launcher, time, *told in self.events]

    def rows(self):
        """On a busy machine the launcher may notice the exec after what the process did next, which then took no time."""
        def after_exec(process, what):
            time = self.first[process].get(what)
            return time and max(time, min(self.zeros) + self.executed[process])

        return [(process, *told, *(after_exec(process, what) for what in ('init', 'node', 'ready', 'callback', 'publication')))
                for process, told in self.processes.items()]


class Machines:

    def __init__(self, trace):
        self.lost = lost_of(trace)
        # Of several recordings, verdicts count what is twice there, or not at all.
        self.has_parts = (len(list(trace.rglob('verdict.json'))) > 1
                          or any(path.name.startswith('snapshot-') for path in trace.rglob('*') if path.is_dir()))
        self.starts = Starts()
        self.events = collections.Counter()  # by process
        self.hosts = collections.defaultdict(set)  # processes
        self.host_of = {}
        self.names = {}  # of the main thread of each process
        self.of_others = {}  # of any thread
        self.threads = set()
        self.asked = collections.defaultdict(lambda: [0, 0])  # by process, callback and begin: calls and bytes
        self.begin = self.end = None
        running = collections.defaultdict(list)
        publishers, subscriptions, published = {}, {}, set()
        for time, host, provider, event, name, numbers, fields in everything_of(trace):
            process, thread = numbers['vpid'], (numbers['vpid'], numbers['vtid'])
            if name and process == thread[1]:
                self.names[process] = name
            if name:
                self.of_others.setdefault(process, name)
            self.host_of[process] = host
            self.hosts[host].add(process)
            if provider == 'launch':
                self.starts.of_launcher(time, event, numbers, fields)
                continue
            self.starts.of_process(time, process, event, numbers, fields)
            self.begin = time if self.begin is None else self.begin
            self.end = time
            self.events[process] += 1
            if event == 'rcl_publisher_init':
                publishers[process, numbers['rmw_publisher_handle']] = dict(TEXT.findall(fields))['topic_name']
            if event == 'callback_start':
                running[thread].append((process, numbers['callback'], time))
            elif event == 'callback_end':
                for one in reversed(running[thread]):
                    if one[1] == numbers['callback']:
                        running[thread].remove(one)
                        break
            elif provider == 'lttng_ust_libc' and event in ASKING and running[thread]:
                memory = self.asked[running[thread][-1]]
                memory[0] += 1
                memory[1] += numbers['size'] * numbers.get('nmemb', 1)
            if event == 'rcl_subscription_init':
                subscriptions[process, numbers['rmw_subscription_handle']] = dict(TEXT.findall(fields))['topic_name']
            topic = subscriptions.get((process, numbers.get('rmw_subscription_handle')))
            if event == 'rmw_take' and numbers['taken'] and (topic, numbers['source_timestamp']) in published:
                self.threads.add(thread)
            if event == 'rmw_publish' and (process, numbers['rmw_publisher_handle']) not in publishers:
                continue  # of the middleware itself
            if event == 'rmw_publish':
                published.add((publishers[process, numbers['rmw_publisher_handle']], numbers['timestamp']))
            if event in ('callback_start', 'rmw_publish', 'rclcpp_intra_publish', 'rclcpp_executor_wait_for_work'):
                self.threads.add(thread)

    def trace_rows(self):
        return [(self.begin, self.end, sum(self.events.values()))]

    def host_rows(self):
        return [(host, len(processes)) for host, processes in self.hosts.items()]

    def process_rows(self):
        return [(process, self.names.get(process, self.of_others.get(process)), host, self.events.get(process)) for process, host in self.host_of.items()]

    def cost_rows(self):
        return [(process, count) for process, count in self.events.items()]

    def allocation_rows(self):
        return [(*instance, *memory) for instance, memory in self.asked.items()]
