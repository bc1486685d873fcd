# SPDX-License-Identifier: Apache-2.0
"""A robot description that a command gives."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, SetLaunchConfiguration
from launch.substitutions import Command, FindExecutable, LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('prefix', default_value=''),
        SetLaunchConfiguration('description', Command([
            FindExecutable(name='cat'), ' ', PathJoinSubstitution([FindPackageShare('demo'), 'config', 'robot.json'])])),
        Node(package='demo', executable='talker', parameters=[{
            'robot_description': ParameterValue(LaunchConfiguration('description'), value_type=str)}]),
    ])
