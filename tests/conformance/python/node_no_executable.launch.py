# SPDX-License-Identifier: Apache-2.0
"""The name that the argument had in earlier releases."""

from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(package='demo', node_executable='talker'),
    ])
