# SPDX-License-Identifier: Apache-2.0
"""A package that is not there."""

from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(package='no_such_package', executable='talker'),
    ])
