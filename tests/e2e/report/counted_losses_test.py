# SPDX-License-Identifier: Apache-2.0
"""What `launch report` says of lost messages, requests and feedback, against nodes that count for themselves."""

import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

PATIENCE = 120  # seconds
PLACES = ('overwritten', 'overwritten_in_buffer', 'lost_by_publisher', 'lost_in_transport', 'filtered', 'not_executed')


def counted(output):
    """The lines of JSON in the output of a launch."""
    return [json.loads(text) for text in re.findall(r'\{"\w+": .*\}', output)]


class CountedLosses(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.directory = Path(tempfile.mkdtemp(prefix='counted_losses_test-'))
        cls.addClassCleanup(shutil.rmtree, cls.directory)
        cls.environment = {name: value for name, value in os.environ.items() if not name.startswith('ROS_')}
        cls.environment.update(ROS_HOME=str(cls.directory), ROS_TRACE_DIR=str(cls.directory / 'traces'))

    def run_launch(self, content, *words):
        file = self.directory / 'system.launch.xml'
        file.write_text(f'<launch><trace session-name="counted" append-timestamp="true" events-ust="ros2:* ros2_ext:*"/>'
                        f'{content}</launch>')
        return subprocess.run([os.environ['LAUNCH_PROGRAM'], *words, file], env=self.environment, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=PATIENCE)

    def report(self, trace, pids):
        """The report without the processes of other tests, which are in the trace, too."""
        run = subprocess.run([os.environ['LAUNCH_REPORT'], trace, '--json'], check=True, stdout=subprocess.PIPE)
        report = json.loads(run.stdout)
        own = {at for at, process in enumerate(report['processes']) if process['vpid'] in pids}
        report['subscriptions'] = [one for one in report['subscriptions'] if one['process'] in own]
        report['calls'] = [one for one in report['calls'] if one['client_process'] in own]
        report['actions'] = [one for one in report['actions'] if one['client_process'] in own]
        return report

    def subscription(self, report, topic, node):
        found = [one for one in report['subscriptions'] if (one['topic'], one['node']) == (topic, node)]
        self.assertEqual(len(found), 1, (topic, node))
        return found[0]

    def check_places(self, subscription, **places):
        for place in PLACES:
            with self.subTest(topic=subscription['topic'], node=subscription['node'], place=place):
                self.assertEqual(subscription[place], places.get(place, 0))

    def test_within_a_machine(self):
        run = self.run_launch(f'<executable name="worker" output="screen" cmd="{os.environ["COUNTING_WORKER"]}"/>', '--isolate')
        self.assertEqual(run.returncode, 0, run.stdout)
        pids = {int(pid) for pid in re.findall(r'process started with pid \[(\d+)\]', run.stdout)}
        report = self.report(next((self.directory / 'traces').iterdir()), pids)
        lines = counted(run.stdout)
        counts = {(one['topic'], one['node']): one for one in lines if 'topic' in one}
        self.assertEqual(len(counts), 11)
        where = {
            '/reader': 'overwritten', '/large_reader': None, '/lossy_reader': 'overwritten',
            '/buffer': 'overwritten_in_buffer', '/deep_buffer': None, '/beside_buffer': 'overwritten',
            '/filter': 'filtered', '/taker': None, '/thrower': None, '/own_executor': 'not_executed', '/visitor': None,
        }
        for (topic, node), count in counts.items():
            subscription = self.subscription(report, topic, node)
            place = where[node]
            with self.subTest(topic=topic, node=node):
                dropped = count['missing'] if place == 'not_executed' else 0
                self.assertEqual(subscription['received'], count['received'] + dropped)
                self.assertEqual(subscription['delivered'], count['received'])
            self.assertEqual(count['missing'] > 0, place is not None, (node, count))
            self.check_places(subscription, **({place: count['missing']} if place else {}))
        visitor = self.subscription(report, '/visitor', '/visitor')
        # Its first one was the third of five, and four came after its end.
        self.assertEqual(visitor['before_first'], counts['/visitor', '/visitor']['first'] - 1)
        self.assertEqual(visitor['after_last'], 4)

        ask = next(one for one in lines if 'service' in one)
        call = next(one for one in report['calls'] if one['service'] == '/ask')
        self.assertEqual((call['requests'], call['responses'], call['in_flight']),
                         (ask['requests'], ask['responses'], 0))

        act = next(one for one in lines if 'action' in one)
        action = next(one for one in report['actions'] if one['name'] == '/act')
        self.assertEqual((action['goals'], action['results'], action['feedback']), (3, act['results'], act['sent']))
        feedback = self.subscription(report, '/act/_action/feedback', '/actor')
        self.assertEqual(feedback['delivered'], act['feedback'])
        self.check_places(feedback, overwritten=act['sent'] - act['feedback'])

    def test_between_machines(self):
        directory = self.directory / 'network'
        worker = os.environ['RADIO_WORKER']
        run = self.run_launch(f'''
          <executable name="receiver" output="screen" cmd="{worker} receiver"/>
          <executable name="sender" output="screen" cmd="{worker} sender"/>
          <test name="a bad radio link" timeout="100">
            <fault do="lose" group="sender" share="0.2"/>
            <exit process="sender"/>
            <exit process="receiver"/>
          </test>''', 'test', '--keep', '--directory', directory)
        if 'faults of the network are not possible here' in run.stdout:
            self.skipTest(run.stdout)
        self.assertEqual(run.returncode, 0, run.stdout)
        output = next(directory.rglob('output.txt')).read_text()
        pids = {int(pid) for pid in re.findall(r'process started with pid \[(\d+)\]', output)}
        trace = next(path for path in directory.rglob('own_traces/*') if path.is_dir())
        report = self.report(trace, pids)
        counts = {one['topic']: one for one in counted(output)}
        for topic, place in (('/reliable', 'lost_by_publisher'), ('/best_effort', 'lost_in_transport')):
            subscription = self.subscription(report, topic, '/receiver')
            self.assertGreater(counts[topic]['missing'], 0, topic)
            self.assertEqual(subscription['delivered'], counts[topic]['received'])
            self.check_places(subscription, **{place: counts[topic]['missing']})


if __name__ == '__main__':
    unittest.main()
