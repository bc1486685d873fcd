# SPDX-License-Identifier: Apache-2.0
"""A group that a condition leaves out, and one that it does not."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, GroupAction
from launch.conditions import IfCondition, UnlessCondition
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('sim', default_value='true'),
        GroupAction(condition=IfCondition(LaunchConfiguration('sim')),
                    actions=[Node(package='demo', executable='talker', name='sim')]),
        GroupAction(condition=UnlessCondition(LaunchConfiguration('sim')),
                    actions=[Node(package='demo', executable='talker', name='real')]),
    ])
