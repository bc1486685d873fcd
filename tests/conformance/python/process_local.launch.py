# SPDX-License-Identifier: Apache-2.0
"""A program by its description."""

from launch import LaunchDescription
from launch.actions import ExecuteLocal
from launch.descriptions import Executable


def generate_launch_description():
    return LaunchDescription([
        ExecuteLocal(process_description=Executable(cmd=['echo', 'a'], name='said', additional_env={'A': 'B'}),
                     output='screen'),
        ExecuteLocal(process_description=Executable(cmd=['echo'], arguments=['b', 'c']), shell=True),
    ])
