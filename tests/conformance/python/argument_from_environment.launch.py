# SPDX-License-Identifier: Apache-2.0
"""A default from the environment, with a default of its own."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import EnvironmentVariable, LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('model', default_value=EnvironmentVariable('ROBOT_MODEL', default_value='burger')),
        Node(package='demo', executable='talker', arguments=[LaunchConfiguration('model')]),
    ])
