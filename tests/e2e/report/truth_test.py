# SPDX-License-Identifier: Apache-2.0
"""
The tables of `launch report --json` against a computation of its own, from what babeltrace2 prints of the same trace: callbacks,
timers, topics, services and executors, of traces of many shapes.
"""

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

LINE = re.compile(r'\[(\d+)\.(\d{9})\] .*? (ros2(?:_ext)?:\w+): (.*)')
FIELD = re.compile(r'(\w+) = (?:"((?:[^"\\]|\\.)*)"|(-?(?:0x)?[0-9A-Fa-f]+)|(\[.*?\](?= \}|, \w+ = )))')


def events_of(trace):
    """(time, name, fields) of the events of ROS 2, in the order of time. An array is its text."""
    text = subprocess.run(['babeltrace2', '--clock-seconds', trace], check=True, stdout=subprocess.PIPE, text=True).stdout
    for line in text.splitlines():
        if match := LINE.match(line):
            fields = {}
            for name, string, number, array in FIELD.findall(match[4]):
                fields[name] = array or (int(number, 0) if number else string)
            yield int(match[1]) * 10**9 + int(match[2]), match[3].split(':')[1], fields


def percentile(values, part):
    """The nearest rank: the smallest value that at least this part of all do not exceed."""
    ordered = sorted(values)
    return ordered[max(-(-len(ordered) * part // 1000), 1) - 1]


class Truth:
    """What the events of a trace say, each process for itself."""

    def __init__(self, trace):
        self.durations = collections.defaultdict(list)  # by process and address of the callback
        self.begins = collections.defaultdict(list)
        self.period = {}  # of callbacks of timers
        self.published = collections.Counter()  # by topic
        self.received = collections.Counter()
        self.latencies = collections.defaultdict(list)
        self.requests = collections.Counter()  # by process and service
        self.responses = collections.Counter()
        self.waited = collections.Counter()  # by process and thread
        self.callbacks_of = collections.Counter()
        self.read(trace)

    def read(self, trace):
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
        for time, name, f in events_of(trace):
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
                topic = topic_of.get((process, f['rmw_subscription_handle']))
                if topic and f['taken']:
                    self.received[topic] += 1
                    taken[thread] = topic, publications.get((topic, f['source_timestamp']))
            elif name == 'callback_start':
                callback = process, f['callback']
                self.begins[callback].append(time)
                running[thread, f['callback']] = time
                topic, published = taken.pop(thread, (None, None))
                if published and not f['is_intra_process']:
                    owner = subscription_of_object.get((process, callback_topic.get(callback)))
                    if owner == topic:
                        self.latencies[topic].append(time - published)
            elif name == 'callback_end':
                if (begin := running.pop((thread, f['callback']), None)) is not None:
                    self.durations[process, f['callback']].append(time - begin)
                    self.callbacks_of[thread] += 1
            elif name == 'rclcpp_client_callback_end':
                self.callbacks_of[thread] += 1
            elif name == 'rmw_send_request' and (process, f['rmw_client_handle']) in services:
                self.requests[process, services[process, f['rmw_client_handle']]] += 1
            elif name == 'rmw_take_response' and f['taken'] and (process, f['rmw_client_handle']) in services:
                self.responses[process, services[process, f['rmw_client_handle']]] += 1
            elif name == 'rclcpp_executor_wait_for_work':
                taken.pop(thread, None)
                waiting[thread] = time
            elif name == 'rclcpp_executor_get_next_ready' and thread in waiting:
                self.waited[thread] += time - waiting.pop(thread)


class Tables(unittest.TestCase):

    def setUp(self):
        self.directory = Path(tempfile.mkdtemp(prefix='truth_test-'))
        self.addCleanup(shutil.rmtree, self.directory)

    def record(self, file, *words, times=1):
        self.started = started(launch(self.directory, '--isolate', file, *words, times=times))
        return self.directory / 'traces'

    def record_text(self, content, attributes='', events='ros2:*'):
        file = self.directory / 'recorded.launch.xml'
        file.write_text(f'<launch><trace session-name="truth" append-timestamp="true" events-ust="{events}" {attributes}/>'
                        f'{content}</launch>')
        return self.record(file)

    def compare(self, summary, values):
        """A distribution against its values."""
        self.assertEqual(summary['count'], len(values))
        if not values:
            return
        mean = sum(values) / len(values)
        self.assertEqual((summary['min_ns'], summary['max_ns']), (min(values), max(values)))
        self.assertAlmostEqual(summary['mean_ns'], mean, delta=1)
        if summary['percentiles_are_exact']:
            for key, part in (('p50_ns', 500), ('p90_ns', 900), ('p99_ns', 990)):
                self.assertEqual(summary[key], percentile(values, part), key)
        self.compared += 1

    def check(self, trace, least):
        run = subprocess.run([os.environ['LAUNCH_REPORT'], trace, '--json'], check=True, stdout=subprocess.PIPE)
        report = json.loads(run.stdout)
        truth = Truth(trace)
        self.compared = 0
        for callback in report['callbacks']:
            key = callback['vpid'], callback['address']
            if callback['owner'] == 'client' or callback['vpid'] not in self.started:
                continue  # its events are those of ros2_ext
            with self.subTest(callback=callback['node'], symbol=callback['symbol']):
                self.compare(callback['duration'], truth.durations[key])
                begins = truth.begins[key]
                intervals = [after - before for before, after in zip(begins, begins[1:])]
                self.compare(callback['interval'], intervals)
                if callback['owner'] == 'timer':
                    period = truth.period[key]
                    self.assertEqual(callback['period_ns'], period)
                    self.compare(callback['jitter'], [abs(interval - period) for interval in intervals])
                    self.assertEqual(callback['missed'], sum((one + period // 2) // period - 1 for one in intervals
                                                             if one > period + period // 2))
                    self.assertEqual(callback['overruns'], sum(one > period for one in truth.durations[key]))
        for topic in report['topics']:
            with self.subTest(topic=topic['name']):
                self.assertEqual(topic['published'], truth.published[topic['name']])
                self.assertEqual(topic['received'], truth.received[topic['name']])
                self.compare(topic['latency'], truth.latencies[topic['name']])
        requests = collections.Counter()
        responses = collections.Counter()
        for call in report['calls']:
            if call['client_vpid'] is None:
                continue  # not in the trace: the service tells
            requests[call['client_vpid'], call['service']] += call['requests']
            responses[call['client_vpid'], call['service']] += call['responses']
        self.assertEqual(requests, truth.requests)
        self.assertEqual(+responses, +truth.responses)
        threads = collections.Counter(process for process, _ in truth.waited)
        for executor in report['executors']:
            key = executor['vpid'], executor['vtid']
            with self.subTest(executor=key):
                if executor['waited_ns'] is None:
                    pass
                elif threads[executor['vpid']] == 1:
                    self.assertEqual(executor['waited_ns'], truth.waited[key])
                else:
                    # While one thread waits for work, the others wait for that one (docs/report.md, "Executors").
                    self.assertGreaterEqual(executor['waited_ns'], truth.waited[key])
                self.assertEqual(executor['callbacks'], truth.callbacks_of[key])
        self.assertGreaterEqual(self.compared, least)

    def test_ping_pong(self):
        self.check(self.record(EXAMPLES / '01_ping_pong.launch.xml', 'period_ms:=20'), 8)

    def test_names_and_remaps(self):
        self.check(self.record_text(f'<include file="{EXAMPLES / "02_names.launch.xml"}"/>'), 4)

    def test_services(self):
        self.check(self.record_text(f'<include file="{EXAMPLES / "07_services.launch.xml"}"/>'), 1)

    def test_actions(self):
        self.check(self.record(EXAMPLES / '10_action.launch.xml'), 3)

    def test_a_lifecycle(self):
        self.check(self.record(EXAMPLES / '11_lifecycle.launch.xml'), 4)

    def test_many_processes(self):
        self.check(self.record(EXAMPLES / '12_reference_system.launch.xml', 'messages:=10'), 60)

    def test_several_threads(self):
        self.check(self.record_text(f'<executable cmd="{os.environ["EXECUTOR_THREADS_WORKER"]}"/>'), 5)

    def test_within_a_process(self):
        self.check(self.record_text(f'<executable cmd="{os.environ["INTRA_PROCESS_WORKER"]}"/>'), 2)

    def test_components(self):
        self.check(self.record(EXAMPLES / '08_composition.launch.xml'), 4)

    def test_two_runs_that_are_appended(self):
        file = self.directory / 'appended.launch.xml'
        file.write_text(f'''<launch><trace session-name="appended" append-trace="true"/>
          <executable cmd="{os.environ["EXECUTOR_THREADS_WORKER"]}"/></launch>''')
        self.check(self.record(file, times=2), 10)

    def test_deadlines(self):
        self.check(self.record(EXAMPLES / '28_deadline.launch.xml'), 1)

    def test_channels(self):
        self.check(self.record(EXAMPLES / '21_trace_channels.launch.xml'), 1)

    def test_small_packets(self):
        self.check(self.record_text(f'<include file="{EXAMPLES / "02_names.launch.xml"}"/>',
                                    'subbuffer-size-ust="16384" subbuffer-count-ust="64"'), 4)

    def test_losses_and_filters(self):
        self.check(self.record_text(f'<executable cmd="{os.environ["COUNTING_WORKER"]}"/>', events='ros2:* ros2_ext:*'), 10)

    def test_the_six_problems(self):
        self.check(self.record(EXAMPLES.parent / 'tests/e2e/report/six_problems.launch.xml',
                               f'worker:={os.environ["SIX_PROBLEMS_WORKER"]}'), 30)

    def test_small_files_of_each_process(self):
        self.check(self.record_text(f'<include file="{EXAMPLES / "02_names.launch.xml"}"/>',
                                    'buffers-ust="pid" subbuffer-size-ust="65536" subbuffer-count-ust="16"'), 4)


if __name__ == '__main__':
    unittest.main()
