# SPDX-License-Identifier: Apache-2.0
"""The content of a file."""

from launch import LaunchDescription
from launch.actions import LogInfo
from launch.substitutions import FileContent, PathJoinSubstitution
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    return LaunchDescription([
        LogInfo(msg=FileContent(PathJoinSubstitution([FindPackageShare('demo'), 'config', 'text.json']))),
    ])
