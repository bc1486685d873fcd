# SPDX-License-Identifier: Apache-2.0
"""An included file whose path is a list of texts."""

from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    return LaunchDescription([
        IncludeLaunchDescription(PythonLaunchDescriptionSource([FindPackageShare('demo'), '/launch',
                                                                '/one.launch.py'])),
    ])
