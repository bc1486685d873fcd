# SPDX-License-Identifier: Apache-2.0
# Three launches, with an argument of the command line, and with the older way to say that all is ready.
import os
import sys
import unittest

import launch
import launch.actions
import launch_testing
import pytest
from ament_index_python import PackageNotFoundError, get_package_prefix
from launch.substitutions import TextSubstitution
from launch.substitutions import LaunchConfiguration

PROGRAM = os.path.join(os.path.dirname(__file__), 'program.py')


@pytest.mark.rostest
@launch_testing.parametrize('word', ['one', 'two', 'three'])
def generate_test_description(word, ready_fn):
    return launch.LaunchDescription([
        launch.actions.DeclareLaunchArgument('greeting', default_value='hello', description='what to say'),
        launch.actions.ExecuteProcess(cmd=[sys.executable, PROGRAM, word, LaunchConfiguration('greeting'), '--wait']),
        launch.actions.OpaqueFunction(function=lambda context: ready_fn()),
    ])


class TestArguments(unittest.TestCase):

    def test_arguments(self, proc_output, word, test_args):
        greeting = test_args.get('greeting', 'hello')
        proc_output.assertWaitFor(f"Called with arguments ['{word}', '{greeting}', '--wait']", timeout=60)

    def test_asks_outside_of_the_thread_of_the_launch(self):
        with self.assertRaisesRegex(PackageNotFoundError, "package 'no_such_package' not found, searching: "):
            get_package_prefix('no_such_package')
        context = launch.LaunchContext()
        context.launch_configurations['name'] = 'value'
        self.assertEqual(LaunchConfiguration('name', default=TextSubstitution(text='')).perform(context), 'value')

    @launch_testing.markers.retry_on_failure(times=3)
    def test_with_more_than_one_try(self):
        self.tries = getattr(self, 'tries', 0) + 1
        self.assertEqual(self.tries, 3)
