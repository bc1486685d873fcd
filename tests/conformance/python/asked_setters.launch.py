# SPDX-License-Identifier: Apache-2.0
"""What actions that set something are made of."""

from launch import LaunchDescription
from launch.actions import LogInfo, SetEnvironmentVariable, SetLaunchConfiguration, UnsetLaunchConfiguration


def generate_launch_description():
    actions = [SetLaunchConfiguration('a', 'b'), SetEnvironmentVariable('A', 'B'), UnsetLaunchConfiguration('c')]
    texts = [actions[0].name[0].describe(), actions[0].value[0].describe(), actions[1].name[0].describe(),
             actions[1].value[0].describe(), actions[2].name[0].describe()]
    return LaunchDescription([
        LogInfo(msg=' '.join(texts)),
        *actions,
    ])
