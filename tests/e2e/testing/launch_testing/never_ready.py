# SPDX-License-Identifier: Apache-2.0
# ReadyToTest stands in a timer that fires too late.
import unittest

import launch
import launch.actions
import launch_testing
import launch_testing.actions


@launch_testing.ready_to_test_action_timeout(0.01)
def generate_test_description():
    return launch.LaunchDescription([
        launch_testing.util.KeepAliveProc(),
        launch.actions.TimerAction(period=600.0, actions=[launch_testing.actions.ReadyToTest()])])


class TestNothing(unittest.TestCase):

    def test_nothing(self):
        pass
