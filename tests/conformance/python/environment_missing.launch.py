# SPDX-License-Identifier: Apache-2.0
"""A variable that is not set."""

from launch import LaunchDescription
from launch.actions import ExecuteProcess
from launch.substitutions import EnvironmentVariable


def generate_launch_description():
    return LaunchDescription([
        ExecuteProcess(cmd=['echo', EnvironmentVariable('NOT_SET_ANYWHERE')]),
    ])
