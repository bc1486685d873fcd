# SPDX-License-Identifier: Apache-2.0
"""Parameters for all nodes that follow."""

from launch import LaunchDescription
from launch.actions import GroupAction
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node, SetParameter


def generate_launch_description():
    return LaunchDescription([
        SetParameter(name='use_sim_time', value=True),
        GroupAction([SetParameter('rate', 5),
                     Node(package='demo', executable='talker', name='a', parameters=[{'rate': 6}])]),
        SetParameter('text', 'a text'),
        SetParameter('n', LaunchConfiguration('n', default='3')),
        Node(package='demo', executable='talker', name='b'),
    ])
