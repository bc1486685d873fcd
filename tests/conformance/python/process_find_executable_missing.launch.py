# SPDX-License-Identifier: Apache-2.0
"""A program that is not on the PATH."""

from launch import LaunchDescription
from launch.actions import ExecuteProcess
from launch.substitutions import FindExecutable


def generate_launch_description():
    return LaunchDescription([
        ExecuteProcess(cmd=[FindExecutable(name='no_such_program_anywhere')]),
    ])
