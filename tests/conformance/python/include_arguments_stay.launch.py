# SPDX-License-Identifier: Apache-2.0
"""What an include sets stays set for the next one."""

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource


def generate_launch_description():
    return LaunchDescription([
        IncludeLaunchDescription(PythonLaunchDescriptionSource(get_package_share_directory(
            'demo') + '/launch/one.launch.py'),
                                 launch_arguments={'name': 'first'}.items()),
        IncludeLaunchDescription(PythonLaunchDescriptionSource(get_package_share_directory(
            'demo') + '/launch/one.launch.py')),
    ])
