# SPDX-License-Identifier: Apache-2.0
"""What `launch report` says of lost messages and lost files, of real runs whose losses are known."""

import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

EXAMPLES = Path(os.environ['SOURCE_DIRECTORY']) / 'launch_examples'
PATIENCE = 120  # seconds


class Losses(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.directory = Path(tempfile.mkdtemp(prefix='losses_test-'))
        cls.addClassCleanup(shutil.rmtree, cls.directory)
        cls.environment = {name: value for name, value in os.environ.items() if not name.startswith('ROS_')}
        cls.environment.update(ROS_HOME=str(cls.directory), ROS_TRACE_DIR=str(cls.directory / 'traces'))

    def record_worker(self, name):
        """The trace of a worker that publishes to itself, with the ends of objects."""
        file = self.directory / f'{name}.launch.xml'
        file.write_text(f'<launch><trace session-name="{name}" append-timestamp="true" events-ust="ros2:* ros2_ext:*"/>'
                        f'<executable cmd="{os.environ["INTRA_PROCESS_WORKER"]}"/></launch>')
        return self.record(file, name)

    def record(self, file, name):
        run = subprocess.run([os.environ['LAUNCH_PROGRAM'], '--isolate', file], env=self.environment, text=True,
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=PATIENCE)
        self.assertEqual(run.returncode, 0, run.stdout)
        self.started = {int(pid) for pid in re.findall(r'process started with pid \[(\d+)\]', run.stdout)}
        return next((self.directory / 'traces').glob(f'{name}-*'))

    def report(self, trace, *words, code=0):
        done = subprocess.run([os.environ['LAUNCH_REPORT'], trace, *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              text=True)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def subscriptions(self, trace):
        """Those of the recorded launch. Programs of other tests are in the trace, too."""
        report = json.loads(self.report(trace, '--json').stdout)
        return [one for one in report['subscriptions'] if report['processes'][one['process']]['vpid'] in self.started]

    def test_a_message_that_is_overwritten_within_the_process(self):
        trace = self.record_worker('within')
        of_topic = [one for one in self.subscriptions(trace) if one['topic'] == '/topic']
        self.assertEqual(sum(one['overwritten_in_buffer'] for one in of_topic), 1)
        self.assertEqual(sum(one['not_executed'] for one in of_topic), 0)

    def test_the_feedback_of_an_action_arrives(self):
        trace = self.record(EXAMPLES / '10_action.launch.xml', 'action')
        feedback = [one for one in self.subscriptions(trace) if one['topic'].endswith('/_action/feedback')]
        self.assertTrue(feedback)
        for subscription in feedback:
            self.assertGreater(subscription['delivered'], 0)
            self.assertEqual(subscription['not_executed'], 0)

    def test_files_that_are_missing(self):
        trace = self.record_worker('files')
        self.assertIn('no events lost', self.report(trace).stdout)
        streams = sorted(path for path in trace.rglob('*') if path.with_name('index').joinpath(path.name + '.idx').exists())
        self.assertTrue(streams)
        stream = max(streams, key=lambda path: path.stat().st_size)
        whole = stream.read_bytes()
        for what, change in (('empty', lambda: stream.write_bytes(b'')), ('missing', stream.unlink),
                             ('a folder', stream.mkdir)):
            with self.subTest(what):
                change()
                for word in ('--json', '--summary'):
                    self.assertIn(stream.name, self.report(trace, word, code=1).stderr)
        stream.rmdir()
        # Without its index, the verdict still tells.
        index = stream.parent / 'index' / (stream.name + '.idx')
        index.unlink()
        self.assertIn('that the session recorded', self.report(trace, '--json', code=1).stderr)
        stream.write_bytes(whole)
        self.assertIn('no events lost', self.report(trace).stdout)


if __name__ == '__main__':
    unittest.main()
