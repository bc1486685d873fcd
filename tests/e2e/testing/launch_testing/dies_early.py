# SPDX-License-Identifier: Apache-2.0
# The only program dies while a test still waits for it.
import unittest

import launch
import launch.actions
import launch_testing.actions


def generate_test_description():
    return launch.LaunchDescription([
        launch.actions.ExecuteProcess(cmd=['sh', '-c', 'echo last words; exit 3'], name='mortal'),
        launch_testing.actions.ReadyToTest()])


class TestNothing(unittest.TestCase):

    def test_waits(self):
        self.proc_output.assertWaitFor('a text that never comes', timeout=600)
