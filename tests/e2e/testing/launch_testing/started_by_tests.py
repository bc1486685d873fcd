# SPDX-License-Identifier: Apache-2.0
# Tests that start programs themselves, beside one that only keeps the launch going.
import os
import sys
import unittest

import launch
import launch.actions
import launch_testing
import launch_testing.actions

PROGRAM = os.path.join(os.path.dirname(__file__), 'program.py')


def generate_test_description():
    return launch.LaunchDescription([launch_testing.util.KeepAliveProc(), launch_testing.actions.ReadyToTest()])


class TestProgram(unittest.TestCase):

    def launched(self, arguments, *more):
        action = launch.actions.ExecuteProcess(cmd=[sys.executable, PROGRAM, *arguments], name='program')
        return launch_testing.tools.launch_process(self.launch_service, action, *more)

    def test_one_that_ends(self, proc_info, proc_output):
        with self.launched(['--foo', 'bar'], proc_info, proc_output) as program:
            self.assertTrue(program.wait_for_shutdown(timeout=60))
            self.assertIn("Called with arguments ['--foo', 'bar']", program.stdout)
            self.assertEqual(program.stderr, 'a complaint\n')
        self.assertEqual(program.exit_code, 0)

    def test_one_that_is_ended(self, proc_info, proc_output):
        with self.launched(['--wait'], proc_info, proc_output) as program:
            self.assertTrue(program.wait_for_output(lambda text: 'Waiting' in text, timeout=60))
            self.assertTrue(program.running)
        self.assertTrue(program.wait_for_shutdown(timeout=60))
        launch_testing.asserts.assertExitCodes(proc_info, process=program.target_process_action)

    def test_one_that_fails(self, proc_info, proc_output):
        with self.launched(['--exception'], proc_info, proc_output) as program:
            self.assertTrue(program.wait_for_shutdown(timeout=60))
        launch_testing.asserts.assertExitCodes(proc_info, [1], process=program.target_process_action)
        self.assertIn('asked to fail', program.output)
