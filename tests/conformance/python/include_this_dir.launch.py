# SPDX-License-Identifier: Apache-2.0
"""An include beside this file."""

from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import ThisLaunchFileDir


def generate_launch_description():
    return LaunchDescription([
        IncludeLaunchDescription(PythonLaunchDescriptionSource([ThisLaunchFileDir(),
                                                                '/argument_default.launch.py']),
                                 launch_arguments={'rate': '20'}.items()),
    ])
