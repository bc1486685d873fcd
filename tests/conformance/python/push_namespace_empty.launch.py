# SPDX-License-Identifier: Apache-2.0
"""A namespace that is empty by default."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, GroupAction
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node, PushRosNamespace


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('namespace', default_value=''),
        GroupAction([PushRosNamespace(LaunchConfiguration('namespace')),
                     Node(package='demo', executable='talker', name='one')]),
        GroupAction([PushRosNamespace(condition=IfCondition(LaunchConfiguration('use', default='false')),
                                      namespace='n'),
                     Node(package='demo', executable='talker', name='two')]),
    ])
