# SPDX-License-Identifier: Apache-2.0
"""Configurations that are kept and restored."""

from launch import LaunchDescription
from launch.actions import LogInfo, PopLaunchConfigurations, PushLaunchConfigurations, SetLaunchConfiguration
from launch.substitutions import LaunchConfiguration


def generate_launch_description():
    return LaunchDescription([
        SetLaunchConfiguration('x', '1'),
        PushLaunchConfigurations(),
        SetLaunchConfiguration('x', '2'),
        LogInfo(msg=LaunchConfiguration('x')),
        PopLaunchConfigurations(),
        LogInfo(msg=LaunchConfiguration('x')),
    ])
