# SPDX-License-Identifier: Apache-2.0
"""A function that makes the actions."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def launch_setup(context, *args, **kwargs):
    count = int(LaunchConfiguration('count').perform(context))
    return [Node(package='demo', executable='talker', name=f'talker_{i}') for i in range(count)]


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('count', default_value='3'),
        OpaqueFunction(function=launch_setup),
    ])
