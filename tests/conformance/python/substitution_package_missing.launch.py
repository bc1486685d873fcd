# SPDX-License-Identifier: Apache-2.0
"""The folder of a package that is not there."""

from launch import LaunchDescription
from launch.actions import LogInfo
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    return LaunchDescription([
        LogInfo(msg=FindPackageShare('no_such_package')),
    ])
