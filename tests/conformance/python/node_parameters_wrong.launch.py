# SPDX-License-Identifier: Apache-2.0
"""A parameter of a kind that no node takes."""

from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(package='demo', executable='talker', parameters=[{'a': None}]),
    ])
