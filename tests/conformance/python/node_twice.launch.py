# SPDX-License-Identifier: Apache-2.0
"""One object twice in a description."""

from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    node = Node(package='demo', executable='talker')
    return LaunchDescription([node, node])
