# SPDX-License-Identifier: Apache-2.0
"""Configurations that are set and unset in between."""

from launch import LaunchDescription
from launch.actions import LogInfo, SetLaunchConfiguration, UnsetLaunchConfiguration
from launch.substitutions import LaunchConfiguration


def generate_launch_description():
    return LaunchDescription([
        SetLaunchConfiguration('who', 'me'),
        LogInfo(msg=LaunchConfiguration('who')),
        SetLaunchConfiguration('who', [LaunchConfiguration('who'), ' again']),
        LogInfo(msg=LaunchConfiguration('who')),
        UnsetLaunchConfiguration('who'),
        LogInfo(msg=LaunchConfiguration('who', default='nobody')),
    ])
