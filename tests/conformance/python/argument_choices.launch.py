# SPDX-License-Identifier: Apache-2.0
"""A default that is one of the choices."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('mode', default_value='fast', choices=['fast', 'slow']),
        Node(package='demo', executable='talker', arguments=['--mode', LaunchConfiguration('mode')]),
    ])
