# SPDX-License-Identifier: Apache-2.0
"""An included Python file with arguments."""

import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource


def generate_launch_description():
    return LaunchDescription([
        IncludeLaunchDescription(
            PythonLaunchDescriptionSource(os.path.join(get_package_share_directory('demo'), 'launch',
                                                       'one.launch.py')),
            launch_arguments={'name': 'first', 'use_sim_time': 'true'}.items()),
    ])
