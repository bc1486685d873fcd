# SPDX-License-Identifier: Apache-2.0
"""Parameters that are no list."""

from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(package='demo', executable='talker', parameters={'a': 1}),
    ])
