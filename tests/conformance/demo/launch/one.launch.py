# SPDX-License-Identifier: Apache-2.0
"""One node, for files that include it."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, LogInfo
from launch.substitutions import LaunchConfiguration, ThisLaunchFileDir
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('name', default_value='one'),
        DeclareLaunchArgument('use_sim_time', default_value='false'),
        LogInfo(msg=['included from ', ThisLaunchFileDir()]),
        Node(package='demo', executable='talker', name=LaunchConfiguration('name'),
             parameters=[{'use_sim_time': LaunchConfiguration('use_sim_time')}]),
    ])
