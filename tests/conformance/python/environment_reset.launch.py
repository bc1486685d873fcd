# SPDX-License-Identifier: Apache-2.0
"""An environment as it was in the beginning."""

from launch import LaunchDescription
from launch.actions import ExecuteProcess, ResetEnvironment, SetEnvironmentVariable
from launch.substitutions import EnvironmentVariable


def generate_launch_description():
    return LaunchDescription([
        SetEnvironmentVariable('A', '1'),
        ResetEnvironment(),
        ExecuteProcess(cmd=['echo', EnvironmentVariable('A', default_value='none')]),
    ])
