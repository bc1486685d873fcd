# SPDX-License-Identifier: Apache-2.0
"""Waits for the messages of a process with launch_testing_ros."""

import os
import unittest

from launch import LaunchDescription
from launch.actions import ExecuteProcess
from launch_testing.actions import ReadyToTest
from launch_testing_ros import WaitForTopics


def generate_test_description():
    talker = ExecuteProcess(cmd=[os.environ['LAUNCH_PROGRAM'], 'topic', 'pub', '/words', 'std_msgs/msg/String',
                                 '{data: hello}', '-r', '20'])
    return LaunchDescription([talker, ReadyToTest()])


class TestTalker(unittest.TestCase):

    def test_it_talks(self):
        with WaitForTopics([('/words', 'std_msgs/msg/String')], timeout=60) as topics:
            self.assertEqual(topics.received_messages('/words')[0].data, 'hello')
