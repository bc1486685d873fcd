# SPDX-License-Identifier: Apache-2.0
# The program ends at once, and the tests go on.
import unittest

import launch
import launch.actions
import launch_testing
import launch_testing.actions


@launch_testing.markers.keep_alive
def generate_test_description():
    program = launch.actions.ExecuteProcess(cmd=['false'])
    return launch.LaunchDescription([program, launch_testing.actions.ReadyToTest()]), {'program': program}


class TestEnd(unittest.TestCase):

    def test_end(self, proc_info, program):
        proc_info.assertWaitForShutdown(program, timeout=60)
        self.assertEqual(proc_info[program].returncode, 1)


@launch_testing.post_shutdown_test()
class TestAfterwards(unittest.TestCase):

    @unittest.skip('nothing to see')
    def test_skipped(self):
        pass
