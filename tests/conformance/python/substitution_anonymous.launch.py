# SPDX-License-Identifier: Apache-2.0
"""A name that nobody else has."""

from launch import LaunchDescription
from launch.substitutions import AnonName
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(package='demo', executable='talker', name=AnonName('talker')),
    ])
