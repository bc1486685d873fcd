# SPDX-License-Identifier: Apache-2.0
"""Folders of packages."""

from launch import LaunchDescription
from launch.actions import LogInfo
from launch.substitutions import TextSubstitution
from launch_ros.substitutions import ExecutableInPackage, FindPackagePrefix, FindPackageShare


def generate_launch_description():
    return LaunchDescription([
        LogInfo(msg=FindPackageShare('demo')),
        LogInfo(msg=FindPackageShare(package='demo')),
        LogInfo(msg=FindPackagePrefix('demo')),
        LogInfo(msg=ExecutableInPackage(package='demo', executable='talker')),
        LogInfo(msg=FindPackageShare([TextSubstitution(text='de'), 'mo'])),
    ])
