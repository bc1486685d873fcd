# SPDX-License-Identifier: Apache-2.0
"""A description that grows."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, LogInfo
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    description = LaunchDescription()
    description.add_action(DeclareLaunchArgument('a', default_value='1'))
    description.add_entity(LaunchDescription([LogInfo(msg=LaunchConfiguration('a'))]))
    for name in ('x', 'y'):
        description.add_action(Node(package='demo', executable='talker', name=name))
    return description
