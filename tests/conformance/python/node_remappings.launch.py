# SPDX-License-Identifier: Apache-2.0
"""Remappings as lists, tuples and substitutions."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('topic', default_value='out'),
        Node(package='demo', executable='talker',
             remappings=[('chatter', '/said'), ('in', LaunchConfiguration('topic'))]),
        Node(package='demo', executable='talker',
             remappings=[((LaunchConfiguration('topic'), '/raw'), ('cooked/', LaunchConfiguration('topic')))]),
        Node(package='demo', executable='talker',
             remappings=list({'/tf': 'tf', '/tf_static': 'tf_static'}.items())),
    ])
