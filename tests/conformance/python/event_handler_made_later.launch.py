# SPDX-License-Identifier: Apache-2.0
"""A handler for a node that was visited before."""

from launch import LaunchDescription
from launch.actions import OpaqueFunction, RegisterEventHandler, Shutdown
from launch.event_handlers import OnProcessExit
from launch_ros.actions import Node


def generate_launch_description():
    node = Node(package='demo', executable='talker', name='n')
    return LaunchDescription([
        node,
        OpaqueFunction(function=lambda context: [RegisterEventHandler(OnProcessExit(target_action=node,
                                                                                    on_exit=[Shutdown()]))]),
        Node(package='demo', executable='talker', name='m'),
    ])
