# SPDX-License-Identifier: Apache-2.0
"""A timer sees what was set when it was visited."""

from launch import LaunchDescription
from launch.actions import GroupAction, LogInfo, SetLaunchConfiguration, TimerAction
from launch.substitutions import LaunchConfiguration


def generate_launch_description():
    return LaunchDescription([
        GroupAction([SetLaunchConfiguration('x', 'inner'),
                     TimerAction(period=1.0, actions=[LogInfo(msg=LaunchConfiguration('x', default='inner'))])]),
    ])
