# SPDX-License-Identifier: Apache-2.0
"""
The tables of `launch report`, those of JSON and the rows of SQL, against a computation of its own, from what babeltrace2 prints
of the same trace: callbacks, timers, topics, messages, services, actions, lifecycle states, executors and chains with their hops.
"""

import collections
import json
import os
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import findings_truth
from deliveries_truth import Deliveries
from machine_truth import Machines
from own_launch import launch, started
from served_truth import Served
from table_queries import DELIVERIES, MACHINES, OF_ONE_PROCESS, SERVED
from trace_truth import Truth, events_of

EXAMPLES = Path(os.environ['SOURCE_DIRECTORY']) / 'launch_examples'
# The talker's third message has been heard.
NAMES = f'''<include file="{EXAMPLES / "02_names.launch.xml"}"><arg name="seconds" value="100"/></include>
  <on_process_io pattern="I heard.*World: 3"><shutdown/></on_process_io>'''

NODE = 'processes.vpid, nodes.name'
OF_NODE = 'LEFT JOIN nodes ON {}.node = nodes.id LEFT JOIN processes ON nodes.process = processes.id'
INSTANCE = """(SELECT processes.vpid || ' ' || callbacks.address || ' ' || start_ns FROM callback_instances
  JOIN callbacks ON callback = callbacks.id JOIN processes ON process = processes.id WHERE callback_instances.id = {})"""
OBJECT = "(SELECT processes.vpid || ' ' || nodes.name || ' ' || {0}s.name FROM {0}s " + OF_NODE.format('{0}s') + ' WHERE {0}s.id = {0})'

# What the tables hold of each event. The first column tells the process, but in those of NOT_OF_ONE_PROCESS.
ROWS = {
    'callback_instances': '''SELECT processes.vpid, callbacks.address, start_ns, duration_ns FROM callback_instances
      JOIN callbacks ON callback = callbacks.id JOIN processes ON process = processes.id WHERE callbacks.kind <> 'client' ''',
    'messages': '''SELECT topics.name, published_ns, taken_ns, callback_ns FROM messages JOIN topics ON topic = topics.id
      WHERE intra_process = 0 AND taken_ns IS NOT NULL''',
    'executor_waits': '''SELECT processes.vpid, threads.vtid, begin_ns, end_ns FROM executor_waits
      JOIN threads ON thread = threads.id JOIN processes ON threads.process = processes.id''',
    'nodes': 'SELECT vpid, nodes.name FROM nodes JOIN processes ON process = processes.id',
    'publishers': f'SELECT {NODE}, topics.name, queue_depth FROM publishers {OF_NODE.format("publishers")} JOIN topics ON topic = topics.id',
    'subscriptions': f'''SELECT {NODE}, topics.name, queue_depth FROM subscriptions {OF_NODE.format("subscriptions")}
      JOIN topics ON topic = topics.id''',
    'timers': f'SELECT {NODE}, period_ns FROM timers {OF_NODE.format("timers")}',
    'services': f'SELECT {NODE}, services.name FROM services {OF_NODE.format("services")}',
    'clients': f'SELECT {NODE}, clients.name FROM clients {OF_NODE.format("clients")}',
    'lifecycle_states': f'SELECT {NODE}, state, begin_ns, end_ns FROM lifecycle_states {OF_NODE.format("lifecycle_states")}',
    'event_counts': "SELECT vpid, substr(event, instr(event, ':') + 1), events FROM event_counts WHERE event GLOB 'ros2:*' OR event GLOB 'ros2_ext:*'",
    'ways': f'''SELECT topics.name, called_ns, rclcpp_ns, rcl_ns, published_ns, {INSTANCE.format("publishing_instance")}, taken_ns,
      {INSTANCE.format("receiving_instance")}, intra_process FROM messages JOIN topics ON topic = topics.id
      WHERE receiving_instance IS NOT NULL''',
    'calls': f'SELECT {OBJECT.format("client")}, {OBJECT.format("service")}, sent_ns, taken_ns, answered_ns, received_ns FROM calls',
    'goals': f'''SELECT action, {NODE}, sent_ns, answered_ns, asked_ns, result_ns FROM goals
      LEFT JOIN nodes ON client = nodes.id LEFT JOIN processes ON nodes.process = processes.id''',
}
# The verdict of the recording knows events that are gone. When a process began to run is known from later events of the launcher.
KNOW_MORE = ('tracing_cost', 'starts')
NOT_OF_ONE_PROCESS = ('messages', 'ways', 'calls', 'goals')
STEPS = '''SELECT vpid, address FROM chain_steps JOIN callbacks ON callback_id = callbacks.id
  JOIN processes ON callbacks.process = processes.id WHERE chain = ? ORDER BY step'''
HOPS = '''SELECT chain_instance, step, chain_hops.begin_ns, duration_ns, until_publish_ns, transfer_ns, executor_ns, take_ns
  FROM chain_hops JOIN chain_instances ON chain_instance = chain_instances.id WHERE chain = ? ORDER BY chain_instance, step'''


def percentile(values, part):
    """The nearest rank: the smallest value that at least this part of all do not exceed."""
    ordered = sorted(values)
    return ordered[max(-(-len(ordered) * part // 1000), 1) - 1]


class TruthCase(unittest.TestCase):

    def setUp(self):
        self.directory = Path(tempfile.mkdtemp(prefix='truth_test-'))
        self.addCleanup(shutil.rmtree, self.directory)

    def record(self, file, *words, times=1):
        self.started = started(launch(self.directory, '--isolate', file, *words, times=times))
        return self.directory / 'traces'

    def record_text(self, content, attributes='', events='ros2:*', append_timestamp='true'):
        file = self.directory / 'recorded.launch.xml'
        file.write_text(f'<launch><trace session-name="truth" append-timestamp="{append_timestamp}" events-ust="{events}" '
                        f'{attributes}/>'
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

    def check(self, trace, least, hops=0, code=0, truth=None, is_whole=True):
        """
        At least so many distributions have values, and chains so many hops. The report ends with this code, and says whether
        anything is missing.
        """
        rows = self.directory / 'rows.sqlite'
        for words in (('--sql', rows), ('--json',)):
            run = subprocess.run([os.environ['LAUNCH_REPORT'], trace, *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            self.assertEqual(run.returncode, code, run.stderr)
        report = json.loads(run.stdout)
        missing = report['losses'] or report['overwritten'] or report['error']
        if is_whole and report['losses']:
            missing = report['overwritten'] or report['error']
            print('events were lost, because this machine is busy: what is there is compared', file=sys.stderr)
        self.assertEqual(not missing, is_whole)
        machines = None if truth else Machines(trace)  # two sessions have the same events twice
        truth = truth or Truth(events_of(trace))
        self.compared = self.compared_hops = 0
        self.check_rows(rows, truth, is_whole)
        self.check_sums(rows, truth, machines, is_whole)
        with self.subTest(table='findings'):
            self.assertEqual(list(findings_truth.faults(report)), [])
        at_address = collections.defaultdict(list)  # one may be where another one was that has gone
        for callback in report['callbacks']:
            at_address[callback['vpid'], callback['address']].append(callback)
        for callback in report['callbacks']:
            key = callback['vpid'], callback['address']
            if callback['owner'] == 'client' or callback['vpid'] not in self.started:
                continue  # its events are those of ros2_ext
            with self.subTest(callback=callback['node'], symbol=callback['symbol']):
                if len(at_address[key]) > 1:
                    self.assertEqual(sum(one['duration']['count'] for one in at_address[key]), len(truth.durations[key]))
                    continue
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
                self.assertEqual(executor['callbacks'], truth.callbacks_of[key], executor)
        self.assertGreaterEqual(self.compared, least)
        self.assertGreaterEqual(self.compared_hops, hops)

    def check_rows(self, file, truth, is_whole):
        """Each row, not only their numbers and distributions. Which way a message took is not certain if events are missing."""
        rows = truth.rows
        expected = {
            'callback_instances': truth.instances, 'messages': truth.ways, 'executor_waits': truth.waits, 'nodes': rows.nodes,
            'event_counts': rows.count_rows(), 'ways': rows.way_rows(), 'calls': rows.call_rows(), 'goals': rows.goal_rows(),
            **{table: rows.of_nodes(getattr(rows, table))
               for table in ('publishers', 'subscriptions', 'timers', 'services', 'clients', 'lifecycle_states')},
        }
        with sqlite3.connect(file) as database:
            for table, query in ROWS.items():
                if table == 'ways' and not is_whole:
                    continue
                with self.subTest(table=table):
                    self.compare_rows(*(collections.Counter(row for row in rows if table in NOT_OF_ONE_PROCESS or row[0] in self.started)
                                        for rows in (database.execute(query), expected[table])))
            chains = database.execute('SELECT id, name FROM chains').fetchall() if is_whole else []
            for chain, name in chains:
                steps = list(database.execute(STEPS, (chain,)))
                expected_hops = rows.hops_of(steps, name is not None)
                undivided = {hop[0] for way in expected_hops for hop in way[1:] if hop[4] is None}
                hops = collections.defaultdict(list)
                for instance, step, begin, duration, until_publish, transfer, executor, take in database.execute(HOPS, (chain,)):
                    way = (until_publish, transfer, None if begin in undivided else executor, take) if step else ()
                    hops[instance].append((begin, duration, *way))
                for each in expected_hops:
                    self.compared_hops += sum(len(hop) > 2 and hop[4] is not None for hop in each)
                with self.subTest(chain=chain, name=name, steps=len(steps)):
                    self.compare_rows(collections.Counter(map(tuple, hops.values())), collections.Counter(expected_hops))
        database.close()

    def check_sums(self, file, truth, machines, is_whole):
        """What the report sums up, and the objects and the machine that it is about."""
        deliveries, served = Deliveries(truth.events), Served(truth.events, truth.rows)
        nodes, doubtful_nodes = served.node_rows()
        published = collections.Counter({name: counts['published'] for name, counts in deliveries.topics.items()})
        expected = [(DELIVERIES, {'subscription_statistics': deliveries.subscription_rows(),
                                  'topic_statistics': deliveries.topic_rows(), 'quality': deliveries.quality_rows()}),
                    (SERVED, {'callbacks': served.callback_rows(), 'node_statistics': nodes,
                              'call_statistics': served.call_rows(), 'actions': served.action_rows(published),
                              'execution_statistics': served.execution_rows(), 'lifecycle_statistics': served.stay_rows()})]
        if machines:
            expected.append((MACHINES, {'trace': machines.trace_rows(), 'hosts': machines.host_rows(),
                                        'processes': machines.process_rows(), 'threads': sorted(machines.threads),
                                        'allocations': machines.allocation_rows(), 'losses': [machines.lost],
                                        'tracing_cost': machines.cost_rows(), 'starts': machines.starts.rows(),
                                        'launcher_events': machines.starts.event_rows()}))
        with sqlite3.connect(file) as database:
            for queries, tables in expected:
                for table, own in tables.items():
                    found = database.execute(queries[table]).fetchall()
                    if table in OF_ONE_PROCESS:
                        found, own = ([row for row in rows if row[0] in self.started] for rows in (found, own))
                    if table in KNOW_MORE and (not is_whole or machines.has_parts):
                        continue
                    if table == 'node_statistics':
                        found = [row for row in found if row[:2] not in doubtful_nodes]
                    if table == 'callbacks':
                        found = [row for row in found if not served.is_reused(row[:2])]
                    with self.subTest(table=table):
                        self.compare_rows(collections.Counter(found), collections.Counter(own))
        database.close()

    def compare_rows(self, found, own):
        only_own, only_found = (sorted(map(str, rows)) for rows in (own - found, found - own))
        self.assertEqual((only_found, only_own), ([], []))
