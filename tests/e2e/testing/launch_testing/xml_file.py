# SPDX-License-Identifier: Apache-2.0
# The system is an XML file, whose processes have no objects in Python.
import os
import unittest

import launch
import launch_testing
import launch_testing.actions
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import AnyLaunchDescriptionSource

FILE = os.path.join(os.path.dirname(__file__), 'system.launch.xml')


def generate_test_description():
    return launch.LaunchDescription([IncludeLaunchDescription(AnyLaunchDescriptionSource(FILE)),
                                     launch_testing.actions.ReadyToTest()])


class TestSystem(unittest.TestCase):

    def test_output(self, proc_output, proc_info):
        proc_output.assertWaitFor('Waiting', process='first', timeout=60)
        proc_output.assertWaitFor('Waiting', process='second', timeout=60)
        proc_info.assertWaitForStartup('first', timeout=60)


@launch_testing.post_shutdown_test()
class TestExit(unittest.TestCase):

    def test_exit_codes(self, proc_info):
        self.assertEqual(len(proc_info.process_names()), 2)
        launch_testing.asserts.assertExitCodes(proc_info)
