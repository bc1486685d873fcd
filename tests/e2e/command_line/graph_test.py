# SPDX-License-Identifier: Apache-2.0
"""`launch graph`: what timers start and conditions leave out, and the graphs of traces."""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

LAUNCH = os.environ['LAUNCH_PROGRAM']

FILE = '''<launch>
  <timer period="1.5"><timer period="2"><executable cmd="/bin/true" name="late"/></timer></timer>
  <node exec="/bin/true" name="there"/>
  <group if="false">
    <node exec="/bin/true" name="absent" namespace="off"><remap from="a" to="/b"/></node>
  </group>
  <executable cmd="/bin/true" name="never" unless="true"/>
</launch>
'''

PYTHON = '''import os
from launch import LaunchDescription
from launch.actions import OpaqueFunction
from launch.conditions import IfCondition


def touch(context):
    open(os.environ['WITNESS'], 'w').close()


def generate_launch_description():
    return LaunchDescription([OpaqueFunction(function=touch, condition=IfCondition('false'))])
'''


class Graph(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.directory = Path(directory.name)
        self.environment = {**os.environ, 'ROS_LOG_DIR': str(self.directory / 'log')}

    def graph(self, *words):
        return subprocess.run([LAUNCH, 'graph', *words], capture_output=True, text=True, env=self.environment,
                              cwd=self.directory)

    def test_timers_and_what_conditions_leave_out_are_marked(self):
        (self.directory / 'system.launch.xml').write_text(FILE)
        result = self.graph('system.launch.xml')
        self.assertEqual((result.returncode, result.stderr), (0, ''))
        for line in ('"/there" [label="/there\\n/bin/true"];',
                     '"process 0" [shape=box, label="late\\nafter 3.5 s"];',
                     '"/off/absent" [style=dashed, color=gray, fontcolor=gray, '
                     'label="/off/absent\\n/bin/true\\nleft out by a condition"];',
                     '"process 1" [shape=box, style=dashed, color=gray, fontcolor=gray, '
                     'label="never\\nleft out by a condition"];',
                     '"/off/absent" -> "topic /b" [dir=none, color=blue, label="a"];'):
            self.assertIn(f'  {line}\n', result.stdout)
        picture = self.graph('--format', 'svg', 'system.launch.xml').stdout
        self.assertEqual(picture.count('left-out"'), 2)
        self.assertIn('after 3.5 s', picture)

    def test_functions_that_a_condition_leaves_out_are_not_called(self):
        (self.directory / 'system.launch.py').write_text(PYTHON)
        self.environment['WITNESS'] = str(self.directory / 'witness')
        self.assertEqual(self.graph('system.launch.py').returncode, 0)
        self.assertFalse((self.directory / 'witness').exists())

    def test_a_trace_has_the_graph_that_its_report_draws(self):
        trace = self.directory / 'example'
        subprocess.run([os.environ['WRITE_EXAMPLE_TRACE'], trace, '10'], check=True)
        result = self.graph('--from-trace', 'example')
        self.assertEqual((result.returncode, result.stderr), (0, ''))
        self.assertRegex(result.stdout, r'(?s)\A//.*\ndigraph system \{.*label="/\w+.*\}\n\Z')
        self.graph('--from-trace', 'example', '-o', 'example.dot')
        self.assertEqual((self.directory / 'example.dot').read_text(), result.stdout)
        self.assertEqual(self.graph('--from-trace', 'nowhere').returncode, 1)

    def test_wrong_use_is_told(self):
        for words, error in ((['--live', '--from-trace', 'x'], '--live and --from-trace exclude each other'),
                             (['--live', 'x.launch.xml'], 'a launch file and a trace exclude each other'),
                             (['--live', '--seconds', 'soon'], "'soon' is no number of seconds above 0"),
                             ([], 'no launch file given')):
            result = self.graph(*words)
            self.assertEqual((result.returncode, result.stderr), (2, f"launch graph: error: {error}\n      = help: see 'launch graph --help'\n"))


if __name__ == '__main__':
    unittest.main()
