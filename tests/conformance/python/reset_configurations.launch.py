# SPDX-License-Identifier: Apache-2.0
"""All configurations but some are forgotten."""

from launch import LaunchDescription
from launch.actions import LogInfo, ResetLaunchConfigurations, SetLaunchConfiguration
from launch.substitutions import LaunchConfiguration


def generate_launch_description():
    return LaunchDescription([
        SetLaunchConfiguration('x', '1'),
        SetLaunchConfiguration('y', '2'),
        ResetLaunchConfigurations(launch_configurations={'y': LaunchConfiguration('x')}),
        LogInfo(msg=[LaunchConfiguration('x', default='gone'), ' ', LaunchConfiguration('y')]),
    ])
