# SPDX-License-Identifier: Apache-2.0
"""The environment of everything that follows."""

from launch import LaunchDescription
from launch.actions import (
    AppendEnvironmentVariable, ExecuteProcess, SetEnvironmentVariable, UnsetEnvironmentVariable)
from launch.substitutions import EnvironmentVariable
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        SetEnvironmentVariable('A', '1'),
        SetEnvironmentVariable(name='B', value=[EnvironmentVariable('A'), '2']),
        ExecuteProcess(cmd=['echo', EnvironmentVariable('B')]),
        UnsetEnvironmentVariable('A'),
        AppendEnvironmentVariable('PATHS', '/one'),
        AppendEnvironmentVariable('PATHS', '/two'),
        AppendEnvironmentVariable('PATHS', '/zero', prepend=True),
        AppendEnvironmentVariable('LIST', 'a', separator=';'),
        AppendEnvironmentVariable('LIST', 'b', separator=';'),
        Node(package='demo', executable='talker'),
    ])
