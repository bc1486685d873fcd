# SPDX-License-Identifier: Apache-2.0
"""
What `launch report` says of messages that wait for their executor, against a computation of its own, from what babeltrace2
prints of the same trace: one process for each node, one topic with several names, an executor with several threads.
"""

import bisect
import collections
import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

from own_launch import launch, started

EXAMPLES = Path(os.environ['SOURCE_DIRECTORY']) / 'launch_examples'
TOLERANCE = 50_000  # ns

LINE = re.compile(r'\[(\d+)\.(\d{9})\] .*? ros2:(\w+): (.*)')
FIELD = re.compile(r'(\w+) = (?:"([^"]*)"|(-?\w+))')


def events_of(trace):
    """(time, name, fields) of the events of ROS 2, in the order of time."""
    text = subprocess.run(['babeltrace2', '--clock-seconds', trace], check=True, stdout=subprocess.PIPE, text=True).stdout
    for line in text.splitlines():
        if match := LINE.match(line):
            fields = {name: text or int(number or '0', 0) for name, text, number in FIELD.findall(match[4])}
            yield int(match[1]) * 10**9 + int(match[2]), match[3], fields


class Waits:
    """The waits of the threads of one process, which all belong to one executor, in the order of time."""

    def __init__(self):
        self.begin_of_thread = {}
        self.look_of_thread = {}
        self.intervals = []
        self.runs = collections.defaultdict(list)  # of each callback that does not run in two threads at once

    def free(self, thread, callback, begin, end):
        """How much of the time a thread waited for work, apart from that in which another thread ran the callback."""
        end = min(end, self.look_of_thread[thread])
        free = 0
        first = max(bisect.bisect_left(self.intervals, (begin,)) - 1, 0)
        for wait_begin, wait_end, waiter in self.intervals[first:]:
            wait = max(begin, wait_begin), min(end, wait_end)
            if wait[0] >= wait[1]:
                continue
            free += wait[1] - wait[0]
            if waiter != thread:
                free -= sum(max(min(wait[1], run[1]) - max(wait[0], run[0]), 0) for run in self.runs[callback])
        return free


def times_of(trace):
    """{(process, topic): the times that messages waited for an executor that did not wait for them, in ns}."""
    processes = collections.defaultdict(Waits)
    topics = {}
    published = {}
    taken = {}
    running = {}
    times = collections.defaultdict(list)
    for time, name, fields in events_of(trace):
        process = fields['vpid']
        thread = process, fields['vtid']
        waits = processes[process]
        if name == 'rcl_subscription_init':
            topics[process, fields['rmw_subscription_handle']] = fields['topic_name']
        elif name == 'rmw_publish':
            published[fields['timestamp']] = time
        elif name == 'rmw_take' and fields['taken'] and fields['source_timestamp'] in published:
            topic = topics.get((process, fields['rmw_subscription_handle']))
            taken[thread] = topic, published[fields['source_timestamp']], time
        elif name == 'rclcpp_executor_wait_for_work':
            waits.begin_of_thread[thread] = time
            taken.pop(thread, None)
        elif name == 'rclcpp_executor_get_next_ready':
            waits.look_of_thread[thread] = time
            if begin := waits.begin_of_thread.pop(thread, None):
                waits.intervals.append((begin, time, thread))
        elif name == 'callback_start':
            callback = fields['callback']
            topic, begin, end = taken.pop(thread, (None, 0, 0))
            if topic and thread in waits.look_of_thread and waits.intervals:
                times[process, topic].append(end - begin - waits.free(thread, callback, begin, end))
            running[thread, callback] = time
        elif name == 'callback_end':
            if begin := running.pop((thread, fields['callback']), None):
                waits.runs[fields['callback']].append((begin, time))
    return times


def p99(values):
    return sorted(values)[(len(values) * 99 + 99) // 100 - 1]


class WaitingForExecutor(unittest.TestCase):

    def setUp(self):
        self.directory = Path(tempfile.mkdtemp(prefix='waiting_for_executor_test-'))
        self.addCleanup(shutil.rmtree, self.directory)

    def record(self, file, *words):
        self.started = started(launch(self.directory, '--isolate', file, *words))
        return next((self.directory / 'traces').iterdir())

    def record_text(self, content):
        file = self.directory / 'recorded.launch.xml'
        file.write_text(f'<launch><trace session-name="waiting" append-timestamp="true"/>{content}</launch>')
        return self.record(file)

    def check(self, trace, topics):
        done = subprocess.run([os.environ['LAUNCH_REPORT'], trace, '--json'], check=True, stdout=subprocess.PIPE)
        report = json.loads(done.stdout)
        computed = times_of(trace)
        compared = 0
        for subscription in report['subscriptions']:
            vpid = report['processes'][subscription['process']]['vpid']
            times = computed.get((vpid, subscription['topic']))
            if vpid not in self.started or not times or subscription['executor']['count'] == 0:
                continue
            with self.subTest(topic=subscription['topic'], node=subscription['node']):
                self.assertEqual(subscription['executor']['count'], len(times))
                self.assertAlmostEqual(subscription['executor']['p99_ns'], p99(times), delta=TOLERANCE)
                self.assertAlmostEqual(subscription['executor']['max_ns'], max(times), delta=TOLERANCE)
            compared += 1
        self.assertGreaterEqual(compared, topics)

    def test_many_processes(self):
        self.check(self.record(EXAMPLES / '12_reference_system.launch.xml', 'messages:=10'), 25)

    def test_names_and_remaps(self):
        self.check(self.record_text(f'<include file="{EXAMPLES / "02_names.launch.xml"}"/>'), 2)

    def test_an_executor_with_several_threads(self):
        self.check(self.record_text(f'<executable cmd="{os.environ["EXECUTOR_THREADS_WORKER"]}"/>'), 1)


if __name__ == '__main__':
    unittest.main()
