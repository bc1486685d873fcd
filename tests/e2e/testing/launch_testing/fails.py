# SPDX-License-Identifier: Apache-2.0
# A failure, an error and a failed expectation after the end.
import unittest

import launch
import launch_testing
import launch_testing.actions


def generate_test_description():
    return launch.LaunchDescription([launch_testing.util.KeepAliveProc(), launch_testing.actions.ReadyToTest()])


class TestFailures(unittest.TestCase):

    def test_error(self):
        raise KeyError('nothing')

    def test_failure(self, proc_info, proc_output):
        proc_info.assertWaitForStartup('keep_alive_proc')
        proc_output.assertWaitFor('never', timeout=0.01)


@launch_testing.post_shutdown_test()
class TestExit(unittest.TestCase):

    def test_exit_codes(self, proc_info):
        launch_testing.asserts.assertExitCodes(proc_info, [7])
