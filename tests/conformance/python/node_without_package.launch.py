# SPDX-License-Identifier: Apache-2.0
"""A program by its path."""

from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(executable='/usr/bin/env', name='env_node', parameters=[{'a': 1}]),
    ])
