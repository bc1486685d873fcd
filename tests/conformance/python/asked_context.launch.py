# SPDX-License-Identifier: Apache-2.0
"""What the context tells."""

from launch import LaunchDescription
from launch.actions import LogInfo, OpaqueFunction, SetLaunchConfiguration
from launch.substitutions import LaunchConfiguration


def launch_setup(context):
    before = sorted(name for name in context.launch_configurations if name in ('a', 'b'))
    context.launch_configurations['c'] = LaunchConfiguration('a').perform(context) + '!'
    return [LogInfo(msg=f'{before} {context.is_shutdown} {"HOME" in context.environment}'),
            LogInfo(msg=LaunchConfiguration('c'))]


def generate_launch_description():
    return LaunchDescription([
        SetLaunchConfiguration('a', '1'),
        SetLaunchConfiguration('b', '2'),
        OpaqueFunction(function=launch_setup),
    ])
