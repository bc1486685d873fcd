# SPDX-License-Identifier: Apache-2.0
"""An argument that no node has."""

from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(package='demo', executable='talker', colour='green'),
    ])
