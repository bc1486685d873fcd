# SPDX-License-Identifier: Apache-2.0
"""The launch file and its folder."""

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription, LogInfo
from launch.launch_description_sources import AnyLaunchDescriptionSource
from launch.substitutions import ThisLaunchFile, ThisLaunchFileDir


def generate_launch_description():
    return LaunchDescription([
        LogInfo(msg=[ThisLaunchFile(), ' ', ThisLaunchFileDir()]),
        IncludeLaunchDescription(AnyLaunchDescriptionSource(
            get_package_share_directory('demo') + '/launch/one.launch.py')),
    ])
