# SPDX-License-Identifier: Apache-2.0
"""An include whose arguments are read."""

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription, LogInfo, SetLaunchConfiguration
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration


def perform(pair):
    name, value = pair
    return f'{name if isinstance(name, str) else name[0].describe()}={type(value).__name__}'


def generate_launch_description():
    include = IncludeLaunchDescription(
        PythonLaunchDescriptionSource(get_package_share_directory('demo') + '/launch/one.launch.py'),
        launch_arguments={'name': LaunchConfiguration('name')}.items())
    names = [perform(part) for part in include.launch_arguments]
    return LaunchDescription([
        SetLaunchConfiguration('name', 'given'),
        LogInfo(msg=str(len(names))),
        include,
    ])
