# SPDX-License-Identifier: Apache-2.0
"""A condition whose predicate is a function of the file."""

from launch import Condition, LaunchDescription
from launch.actions import LogInfo, SetLaunchConfiguration


def generate_launch_description():
    return LaunchDescription([
        SetLaunchConfiguration('count', '3'),
        LogInfo(msg='many',
                condition=Condition(predicate=lambda context: int(context.launch_configurations['count']) > 2)),
        LogInfo(msg='few',
                condition=Condition(predicate=lambda context: int(context.launch_configurations['count']) < 2)),
    ])
