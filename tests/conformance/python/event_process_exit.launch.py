# SPDX-License-Identifier: Apache-2.0
"""A node that starts when another one has ended."""

from launch import LaunchDescription
from launch.actions import RegisterEventHandler
from launch.event_handlers import OnProcessExit
from launch_ros.actions import Node


def generate_launch_description():
    spawner = Node(package='demo', executable='talker', name='spawner')
    return LaunchDescription([
        spawner,
        RegisterEventHandler(OnProcessExit(target_action=spawner,
                                           on_exit=[Node(package='demo', executable='talker', name='later')])),
    ])
