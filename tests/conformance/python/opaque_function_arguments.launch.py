# SPDX-License-Identifier: Apache-2.0
"""A function that gets more arguments."""

from launch import LaunchDescription
from launch.actions import LogInfo, OpaqueFunction, SetLaunchConfiguration
from launch.substitutions import LaunchConfiguration


def launch_setup(context, prefix, *names, suffix=''):
    return [LogInfo(msg=prefix + context.perform_substitution(name) + suffix) for name in names]


def generate_launch_description():
    return LaunchDescription([
        SetLaunchConfiguration('a', 'A'),
        OpaqueFunction(function=launch_setup, args=['<', LaunchConfiguration('a')], kwargs={'suffix': '>'}),
    ])
