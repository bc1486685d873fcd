# SPDX-License-Identifier: Apache-2.0
"""A function that raises an error."""

from launch import LaunchDescription
from launch.actions import OpaqueFunction
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        OpaqueFunction(function=lambda context: 1 / 0),
        Node(package='demo', executable='talker'),
    ])
