# SPDX-License-Identifier: Apache-2.0
"""An included Python file whose path is a substitution."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('name', default_value='outer'),
        IncludeLaunchDescription(
            PythonLaunchDescriptionSource(PathJoinSubstitution([FindPackageShare('demo'), 'launch',
                                                                'one.launch.py'])),
            launch_arguments=[('name', LaunchConfiguration('name'))]),
    ])
