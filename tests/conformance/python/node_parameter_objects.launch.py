# SPDX-License-Identifier: Apache-2.0
"""Parameter objects."""

from launch import LaunchDescription
from launch.actions import SetLaunchConfiguration
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
from launch_ros.descriptions import Parameter


def generate_launch_description():
    return LaunchDescription([
        SetLaunchConfiguration('n', '7'),
        Node(package='demo', executable='talker', parameters=[
            Parameter('a', 1), Parameter('b', LaunchConfiguration('n')),
            Parameter('c', LaunchConfiguration('n'), value_type=str),
            Parameter('d', [1.5, 2.5])]),
    ])
