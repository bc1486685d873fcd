# SPDX-License-Identifier: Apache-2.0
"""Paths that are joined."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, LogInfo
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution, PathSubstitution
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('file', default_value='demo.yaml'),
        LogInfo(msg=PathJoinSubstitution(['a', 'b', '/c', 'd'])),
        LogInfo(msg=PathJoinSubstitution([FindPackageShare('demo'), 'config', LaunchConfiguration('file')])),
        LogInfo(msg=PathSubstitution(FindPackageShare('demo')) / 'config' / LaunchConfiguration('file')),
        LogInfo(msg=PathSubstitution('x') / ['y_', LaunchConfiguration('file')] / 'z'),
        LogInfo(msg=PathJoinSubstitution(['a', ['b_', LaunchConfiguration('file')]])),
    ])
