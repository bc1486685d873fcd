# SPDX-License-Identifier: Apache-2.0
"""`launch check --from-trace DIR`: what a recorded run tells of the remaps of a launch file."""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

# The recorded nodes: /sensor publishes /scan, /filter takes it and publishes /points, /display takes that. Each has a
# process of the same name.
FILE = '''<launch>
  <node exec="PROGRAM" name="sensor"><remap from="scan" to="laser"/><remap from="sacn" to="a"/></node>
  <node exec="PROGRAM" name="filter"><remap from="somewhere" to="points"/><remap from="/tf" to="tf"/></node>
  <node exec="PROGRAM" name="display"><remap from="~/points" to="b"/><remap from="points" to="c"/></node>
  <node exec="OTHER"><remap from="rostopic://points" to="d"/><remap from="pionts" to="d"/></node>
  <node exec="PROGRAM" name="unknown"><remap from="anything" to="e"/></node>
</launch>
'''


class CheckWithATrace(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.directory = Path(directory.name).resolve()
        program = self.directory / 'display'
        program.write_text('#!/bin/sh\n')
        program.chmod(0o755)
        (self.directory / 'a.launch.xml').write_text(FILE.replace('PROGRAM', '/bin/true').replace('OTHER', str(program)))

    def check(self, *words):
        return subprocess.run([os.environ['LAUNCH_PROGRAM'], 'check', *words], cwd=self.directory, capture_output=True,
                              text=True, timeout=60)

    def test_remaps_of_names_that_no_recorded_node_has(self):
        subprocess.run([os.environ['WRITE_EXAMPLE_TRACE'], self.directory / 'example', '10'], check=True)
        self.assertEqual(self.check('a.launch.xml').stdout, '1 file: 0 errors, 0 warnings\n')
        result = self.check('--from-trace', 'example', 'a.launch.xml')
        self.assertEqual((result.returncode, result.stderr), (0, ''))
        found = [line.replace(f'{self.directory}/', '') for line in result.stdout.splitlines()
                 if 'warning' in line or 'help' in line]
        self.assertEqual(found, [
            "a.launch.xml:3:4: warning: remap '/tf:=tf' changes nothing: the recorded node '/filter' has neither name [LF0403]",
            "a.launch.xml:5:4: warning: remap 'pionts:=d' changes nothing: the recorded node '/display' has neither name "
            '[LF0403]',
            "      = help: did you mean '/points'?",
            "a.launch.xml:2:4: warning: remap 'sacn:=a' changes nothing: the recorded node '/sensor' has neither name [LF0403]",
            "      = help: did you mean '/scan'?",
            "a.launch.xml:4:4: warning: remap '~/points:=b' changes nothing: the recorded node '/display' has neither name "
            '[LF0403]',
            '1 file: 0 errors, 4 warnings'])

    def test_a_trace_that_tells_nothing(self):
        result = self.check('--from-trace', 'nowhere', 'a.launch.xml')
        self.assertEqual((result.returncode, result.stdout), (1, ''))
        self.assertIn('nowhere', result.stderr)


PARAMETERS = '''<launch>
  <node exec="/bin/true" name="talker" ros_args="-p raet:=3 -p use_sim_time:=true">
    <param name="rate" value="1"/><param name="pose.x" value="1.0"/><param name="pose.z" value="1.0"/>
    <param from="params.yaml"/>
  </node>
  <node exec="/bin/true" name="other"><param name="anything" value="1"/></node>
</launch>
'''


class CheckWithParameters(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.directory = Path(directory.name).resolve()
        (self.directory / 'a.launch.xml').write_text(PARAMETERS)
        (self.directory / 'params.yaml').write_text(
            '/talker:\n  ros__parameters:\n    rate: 1\n    tare: 2\n/**:\n  ros__parameters:\n    of_all: 1\n')
        (self.directory / 'dump.yaml').write_text(
            '/talker:\n  ros__parameters:\n    pose:\n      x: 0.0\n      y: 0.0\n    rate: 5\n    use_sim_time: false\n')

    def check(self, *words):
        return subprocess.run([os.environ['LAUNCH_PROGRAM'], 'check', *words], cwd=self.directory, capture_output=True,
                              text=True, timeout=60)

    def test_parameters_that_a_node_does_not_have(self):
        self.assertEqual(self.check('a.launch.xml').stdout, '1 file: 0 errors, 0 warnings\n')
        result = self.check('--from-parameters', 'dump.yaml', 'a.launch.xml')
        self.assertEqual((result.returncode, result.stderr), (0, ''))
        found = [line.replace(f'{self.directory}/', '') for line in result.stdout.splitlines()
                 if 'warning' in line or 'help' in line]
        self.assertEqual(found, [
            "a.launch.xml:2:4: warning: node '/talker' had no parameter 'pose.z' when it was dumped [LF0406]",
            "      = help: did you mean 'pose.x'?",
            "a.launch.xml:2:4: warning: node '/talker' had no parameter 'raet' when it was dumped [LF0406]",
            "      = help: did you mean 'rate'?",
            "params.yaml:4:5: warning: node '/talker' had no parameter 'tare' when it was dumped [LF0406]",
            '1 file: 0 errors, 3 warnings'])

    def test_files_that_tell_nothing(self):
        (self.directory / 'empty.yaml').write_text('a: 1\n')
        for file, words in (('nowhere.yaml', 'nowhere.yaml'),
                            ('empty.yaml', "'empty.yaml' holds no parameters of a node\n"
                                           '      = help: launch param dump NODE > FILE writes them\n')):
            result = self.check('--from-parameters', file, 'a.launch.xml')
            self.assertEqual((result.returncode, result.stdout), (1, ''))
            self.assertIn(words, result.stderr)


if __name__ == '__main__':
    unittest.main()
