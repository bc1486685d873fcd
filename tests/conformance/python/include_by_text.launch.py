# SPDX-License-Identifier: Apache-2.0
"""An include whose source is just the path."""

from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.substitutions import PathJoinSubstitution
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    return LaunchDescription([
        IncludeLaunchDescription(PathJoinSubstitution([FindPackageShare('demo'), 'launch', 'one.launch.py'])),
    ])
