# SPDX-License-Identifier: Apache-2.0
"""A default that is pasted together."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, LogInfo
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('robot', default_value='r1'),
        DeclareLaunchArgument('frame', default_value=[LaunchConfiguration('robot'), '/base_link']),
        LogInfo(msg=['frame is ', LaunchConfiguration('frame')]),
        Node(package='demo', executable='talker', parameters=[{'frame': LaunchConfiguration('frame')}]),
    ])
