# SPDX-License-Identifier: Apache-2.0
"""A condition that is neither true nor false."""

from launch import LaunchDescription
from launch.actions import LogInfo
from launch.conditions import IfCondition


def generate_launch_description():
    return LaunchDescription([
        LogInfo(msg='never', condition=IfCondition('maybe')),
    ])
