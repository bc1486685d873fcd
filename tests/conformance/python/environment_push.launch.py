# SPDX-License-Identifier: Apache-2.0
"""An environment that is kept and restored."""

from launch import LaunchDescription
from launch.actions import ExecuteProcess, GroupAction, PopEnvironment, PushEnvironment, SetEnvironmentVariable


def generate_launch_description():
    return LaunchDescription([
        PushEnvironment(),
        SetEnvironmentVariable('A', 'inner'),
        ExecuteProcess(cmd=['echo', '1']),
        PopEnvironment(),
        ExecuteProcess(cmd=['echo', '2']),
        GroupAction([SetEnvironmentVariable('A', 'group'), ExecuteProcess(cmd=['echo', '3'])]),
        ExecuteProcess(cmd=['echo', '4']),
    ])
