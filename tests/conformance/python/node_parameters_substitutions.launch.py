# SPDX-License-Identifier: Apache-2.0
"""Parameters that are substitutions get the type of their text."""

from launch import LaunchDescription
from launch.actions import SetLaunchConfiguration
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        SetLaunchConfiguration('n', '7'),
        SetLaunchConfiguration('f', '1.5'),
        SetLaunchConfiguration('b', 'true'),
        SetLaunchConfiguration('s', 'text'),
        SetLaunchConfiguration('l', '[1, 2]'),
        Node(package='demo', executable='talker', parameters=[{
            'n': LaunchConfiguration('n'), 'f': LaunchConfiguration('f'), 'b': LaunchConfiguration('b'),
            's': LaunchConfiguration('s'),
            'l': LaunchConfiguration('l'), 'pasted': ['is_', LaunchConfiguration('n')],
            'pasted_number': [LaunchConfiguration('n'), '0'],
            'list': [[LaunchConfiguration('n')], [LaunchConfiguration('n'), '1']],
            LaunchConfiguration('s'): 'name'}]),
    ])
