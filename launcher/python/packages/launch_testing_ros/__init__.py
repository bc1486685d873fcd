# SPDX-License-Identifier: Apache-2.0
"""
What tests of ROS nodes need, as ROS 2's package of this name has it.

WaitForTopics works with the launcher's own tools. MessagePump and DataRepublisher work on a node of rclpy, which is no
part of this launcher. docs/launch_testing.md lists the names.
"""

from launch import _names
from launch_testing.test_runner import LaunchTestRunner
from launch_testing_ros import actions, tools
from launch_testing_ros.data_republisher import DataRepublisher
from launch_testing_ros.message_pump import MessagePump
from launch_testing_ros.wait_for_topics import WaitForTopics

__all__ = ['DataRepublisher', 'LaunchTestRunner', 'MessagePump', 'WaitForTopics', 'actions', 'tools']

_names.same_module('launch_testing.test_runner', __name__ + '.test_runner')
_names.one_class_modules(actions.__name__)
