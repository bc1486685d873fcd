# SPDX-License-Identifier: Apache-2.0
"""A program that is not there."""

from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(package='demo', executable='no_such_program'),
    ])
