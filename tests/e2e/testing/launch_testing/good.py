# SPDX-License-Identifier: Apache-2.0
# All that holds for a program that runs until it is ended.
import os
import re
import sys
import unittest

import launch
import launch.actions
import launch_testing
import launch_testing.actions
import launch_testing.asserts
import pytest
from launch_testing.asserts import assertSequentialStdout
from launch_testing.tools.text import normalize_lineseps
from launch_testing_ros.actions import EnableRmwIsolation
from launch_testing_ros.actions import enable_rmw_isolation

PROGRAM = os.path.join(os.path.dirname(__file__), 'program.py')


@pytest.mark.launch_test
def generate_test_description():
    program = launch.actions.ExecuteProcess(cmd=[sys.executable, PROGRAM, '--wait'], name='program')
    other = launch.actions.ExecuteProcess(cmd=[sys.executable, PROGRAM, '--wait', 'again'], name='program_other')
    return launch.LaunchDescription([EnableRmwIsolation(), program, other, launch_testing.actions.ReadyToTest()]), {'program': program}


class TestWhileItRuns(unittest.TestCase):

    @classmethod
    def setUpClass(cls, program):
        cls.program_of_class = program

    def setUp(self, proc_info):
        proc_info.assertWaitForStartup(process=self.program_of_class, timeout=60)

    def test_names_of_releases(self):
        self.assertIs(enable_rmw_isolation.EnableRmwIsolation, EnableRmwIsolation)
        self.assertIs(launch.actions.execute_process.ExecuteProcess, launch.actions.ExecuteProcess)
        self.assertIs(launch.event_handlers.on_process_start.OnProcessStart, launch.event_handlers.OnProcessStart)
        self.assertEqual(normalize_lineseps('a\r\nb\n'), 'a\nb\n')
        self.assertGreater(int(os.environ['ROS_DOMAIN_ID']), 0)

    def test_output_comes(self, proc_output, program):
        proc_output.assertWaitFor('Waiting', process=program, timeout=60)
        self.proc_output.assertWaitFor(re.compile(r'^Loop \d$', re.MULTILINE), process=program, timeout=60)
        proc_output.assertWaitFor('a complaint', process=program, stream='stderr', timeout=60)
        proc_output.assertWaitFor(expected_output='a complaint', process=program, timeout=60)
        self.assertFalse(proc_output.waitFor('a complaint', process=program, stream='stdout', timeout=0.01))
        proc_output.assertWaitFor(['Loop 1', 'Loop 3'], process=program, timeout=60)
        self.assertFalse(proc_output.waitFor(['Loop 3', 'Loop 1'], process=program, timeout=0.01))
        proc_output.assertWaitFor('Waiting', process='program', cmd_args=['again'], timeout=60)

    def test_a_name_may_mean_several(self, proc_output, proc_info):
        proc_info.assertWaitForStartup('program_other', timeout=60)
        with self.assertRaisesRegex(Exception, "Found multiple processes matching name 'program'"):
            launch_testing.asserts.assertInStdout(proc_output, 'Waiting', 'program')
        with self.assertRaisesRegex(launch_testing.util.NoMatchingProcessException,
                                    "Did not find any processes matching name 'nobody' and args 'None'. Procs: program"):
            launch_testing.asserts.assertInStdout(proc_output, 'Waiting', 'nobody')

    def test_of_a_process_that_is_nowhere(self, proc_info):
        with self.assertRaisesRegex(AssertionError, "Timed out waiting for process 'nobody' to start"):
            proc_info.assertWaitForStartup('nobody', timeout=0.01)


@launch_testing.post_shutdown_test()
class TestAfterShutdown(unittest.TestCase):

    def test_exit_codes(self, proc_info, program):
        launch_testing.asserts.assertExitCodes(proc_info)
        self.assertEqual(self.proc_info[program].returncode, 0)
        self.assertEqual(proc_info['program'].returncode, 0)
        self.assertEqual(len(list(proc_info)), 2)

    def test_output_in_its_order(self, proc_output, program):
        with assertSequentialStdout(proc_output, program) as output:
            output.assertInStdout('Starting Up')
            output.assertInStdout('Waiting')
            output.assertInStdout('Shutting Down')
        with self.assertRaisesRegex(AssertionError, "'Starting Up' not found in sequence after previous match"):
            with assertSequentialStdout(proc_output, program) as output:
                output.assertInStdout('Waiting')
                output.assertInStdout('Starting Up')

    def test_output_with_and_without_escapes(self, proc_output, program):
        launch_testing.asserts.assertInStdout(proc_output, 'Loop 2', program)
        launch_testing.asserts.assertInStdout(proc_output, '\033[1mLoop', program, strip_ansi_escape_sequences=False)
        launch_testing.asserts.assertInStderr(proc_output, 'a complaint', program)
        with self.assertRaisesRegex(AssertionError, "Did not find 'a complaint' in output for any of the matching"):
            launch_testing.asserts.assertInStdout(proc_output, 'a complaint', program)
        without_loops = launch_testing.tools.basic_output_filter(filtered_prefixes=['Loop'])
        with self.assertRaises(AssertionError):
            launch_testing.asserts.assertInStdout(proc_output, 'Loop', program, output_filter=without_loops)
