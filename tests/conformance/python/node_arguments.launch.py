# SPDX-License-Identifier: Apache-2.0
"""Arguments of all kinds."""

from launch import LaunchDescription
from launch.actions import SetLaunchConfiguration
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    return LaunchDescription([
        SetLaunchConfiguration('w', 'a b'),
        Node(package='demo', executable='talker',
             arguments=['one', 'two words', LaunchConfiguration('w'), ['x', LaunchConfiguration('w')], ''],
             ros_arguments=['--log-level', 'debug']),
        Node(package='demo', executable='talker',
             arguments=['-d', PathJoinSubstitution([FindPackageShare('demo'), 'rviz', 'demo.rviz']),
                                                             '--ros-args', '--log-level', ['demo:=', 'warn']]),
    ])
