# SPDX-License-Identifier: Apache-2.0
"""What a group without a scope sets stays."""

from launch import LaunchDescription
from launch.actions import GroupAction, LogInfo, SetLaunchConfiguration
from launch.substitutions import LaunchConfiguration


def generate_launch_description():
    return LaunchDescription([
        GroupAction(actions=[SetLaunchConfiguration('x', 'inner')], scoped=False),
        LogInfo(msg=LaunchConfiguration('x')),
    ])
