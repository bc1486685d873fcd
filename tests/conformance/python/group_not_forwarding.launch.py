# SPDX-License-Identifier: Apache-2.0
"""A group that sees only what it is given."""

from launch import LaunchDescription
from launch.actions import GroupAction, LogInfo, SetLaunchConfiguration
from launch.substitutions import LaunchConfiguration


def generate_launch_description():
    return LaunchDescription([
        SetLaunchConfiguration('x', 'outer'),
        GroupAction(actions=[LogInfo(msg=[LaunchConfiguration('x', default='none'), LaunchConfiguration('y')])],
                    forwarding=False, launch_configurations={'y': LaunchConfiguration('x')}),
    ])
