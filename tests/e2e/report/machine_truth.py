# SPDX-License-Identifier: Apache-2.0
"""
What a trace says of machines, processes, threads, memory and starts, from all events that babeltrace2 prints, whatever provider
they have, with nothing of the reader and the analysis of this project.
"""

import collections
import re
import subprocess

LINE = re.compile(r'\[(\d+)\.(\d{9})\] \([^)]*\) (\S+) (\w+):(\w+): \{[^}]*\}, \{(.*?)\}, \{(.*)\}$')
NAME = re.compile(r'procname = "((?:[^"\\]|\\.)*)"')
NUMBER = re.compile(r'(\w+) = (-?(?:0x)?[0-9A-Fa-f]+)')
ASKING = ('malloc', 'calloc', 'realloc', 'memalign', 'posix_memalign')


def everything_of(trace):
    """(time, host, provider, event, name of the thread, numbers of the context and of the fields, text) in the order of time."""
    run = subprocess.run(['babeltrace2', '--clock-seconds', trace], check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                         text=True)
    for line in run.stdout.splitlines():
        match = LINE.match(line)
        assert match, line
        seconds, nanoseconds, host, provider, event, context, fields = match.groups()
        name = NAME.search(context)
        numbers = {key: int(value, 0) for key, value in NUMBER.findall(NAME.sub('', context) + ' ' + fields)}
        yield int(seconds) * 10**9 + int(nanoseconds), host, provider, event, name and name[1], numbers, fields


class Machines:

    def __init__(self, trace):
        self.events = collections.Counter()  # by process
        self.hosts = collections.defaultdict(set)  # processes
        self.host_of = {}
        self.names = {}  # of the main thread of each process
        self.threads = set()
        self.asked = collections.defaultdict(lambda: [0, 0])  # by process, callback and begin: calls and bytes
        self.begin = self.end = None
        running = collections.defaultdict(list)
        publishers = set()
        for time, host, provider, event, name, numbers, _ in everything_of(trace):
            process, thread = numbers['vpid'], (numbers['vpid'], numbers['vtid'])
            if process == thread[1]:
                self.names[process] = name
            self.host_of[process] = host
            self.hosts[host].add(process)
            if provider == 'launch':
                continue
            self.begin = time if self.begin is None else self.begin
            self.end = time
            self.events[process] += 1
            if event == 'rcl_publisher_init':
                publishers.add((process, numbers['rmw_publisher_handle']))
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
            if event == 'rmw_publish' and (process, numbers['rmw_publisher_handle']) not in publishers:
                continue  # of the middleware itself
            if event in ('callback_start', 'rmw_publish', 'rclcpp_intra_publish', 'rclcpp_executor_wait_for_work'):
                self.threads.add(thread)

    def trace_rows(self):
        return [(self.begin, self.end, sum(self.events.values()))]

    def host_rows(self):
        return [(host, len(processes)) for host, processes in self.hosts.items()]

    def process_rows(self):
        return [(process, self.names.get(process), host, self.events.get(process)) for process, host in self.host_of.items()]

    def allocation_rows(self):
        return [(*instance, *memory) for instance, memory in self.asked.items()]
