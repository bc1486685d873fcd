# SPDX-License-Identifier: Apache-2.0
"""A name that no node can have."""

from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(package='demo', executable='talker', name='not-a-name'),
    ])
