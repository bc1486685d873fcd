# SPDX-License-Identifier: Apache-2.0
"""An include of a file that is not there."""

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource


def generate_launch_description():
    return LaunchDescription([
        IncludeLaunchDescription(PythonLaunchDescriptionSource(get_package_share_directory(
            'demo') + '/launch/none.launch.py')),
    ])
