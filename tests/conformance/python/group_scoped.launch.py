# SPDX-License-Identifier: Apache-2.0
"""What a group sets ends with the group."""

from launch import LaunchDescription
from launch.actions import GroupAction, LogInfo, SetLaunchConfiguration
from launch.substitutions import LaunchConfiguration


def generate_launch_description():
    return LaunchDescription([
        SetLaunchConfiguration('x', 'outer'),
        GroupAction([SetLaunchConfiguration('x', 'inner'), LogInfo(msg=LaunchConfiguration('x'))]),
        LogInfo(msg=LaunchConfiguration('x')),
    ])
