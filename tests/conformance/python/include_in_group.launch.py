# SPDX-License-Identifier: Apache-2.0
"""An include in a namespace."""

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import GroupAction, IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch_ros.actions import PushRosNamespace, SetRemap


def generate_launch_description():
    return LaunchDescription([
        GroupAction([
            PushRosNamespace('left'),
            IncludeLaunchDescription(PythonLaunchDescriptionSource(get_package_share_directory(
                'demo') + '/launch/one.launch.py')),
        ]),
        GroupAction([
            PushRosNamespace('right'),
            SetRemap(src='chatter', dst='said'),
            IncludeLaunchDescription(PythonLaunchDescriptionSource(get_package_share_directory(
                'demo') + '/launch/one.launch.py')),
        ]),
    ])
