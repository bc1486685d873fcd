# SPDX-License-Identifier: Apache-2.0
"""A handler that is unregistered again."""

from launch import LaunchDescription
from launch.actions import RegisterEventHandler, UnregisterEventHandler
from launch.event_handlers import OnProcessExit
from launch_ros.actions import Node


def generate_launch_description():
    node = Node(package='demo', executable='talker')
    handler = OnProcessExit(target_action=node, on_exit=[Node(package='demo', executable='talker', name='never')])
    return LaunchDescription([
        node,
        RegisterEventHandler(handler),
        UnregisterEventHandler(handler),
    ])
