# SPDX-License-Identifier: Apache-2.0
"""A file of parameters that is not there is left out."""

from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(package='demo', executable='talker', parameters=['/nowhere/at/all.yaml', {'a': 1}]),
    ])
