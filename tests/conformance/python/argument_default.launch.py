# SPDX-License-Identifier: Apache-2.0
"""An argument with a default, used as a parameter."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('rate', default_value='10', description='messages per second'),
        Node(package='demo', executable='talker', parameters=[{'rate': LaunchConfiguration('rate')}]),
    ])
