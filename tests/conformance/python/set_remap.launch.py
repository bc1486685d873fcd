# SPDX-License-Identifier: Apache-2.0
"""Remappings for all nodes that follow."""

from launch import LaunchDescription
from launch.actions import GroupAction
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node, SetRemap


def generate_launch_description():
    return LaunchDescription([
        SetRemap(src='a', dst='b'),
        GroupAction([SetRemap('c', LaunchConfiguration('x', default='d')),
                     Node(package='demo', executable='talker', name='one', remappings=[('e', 'f')])]),
        Node(package='demo', executable='talker', name='two'),
    ])
