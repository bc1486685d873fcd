# SPDX-License-Identifier: Apache-2.0
"""A required argument that nobody gives."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('map'),
        Node(package='demo', executable='talker', arguments=[LaunchConfiguration('map')]),
    ])
