# SPDX-License-Identifier: Apache-2.0
"""Expressions."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, LogInfo
from launch.substitutions import LaunchConfiguration, PythonExpression


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('n', default_value='4'),
        LogInfo(msg=PythonExpression([LaunchConfiguration('n'), ' * 2'])),
        LogInfo(msg=PythonExpression(["'a' if int('", LaunchConfiguration('n'), "') > 3 else 'b'"])),
        LogInfo(msg=PythonExpression(['not ', 'True'])),
        LogInfo(msg=PythonExpression(['math.sqrt(', LaunchConfiguration('n'), ')'], ['math'])),
        LogInfo(msg=PythonExpression(['[i for i in range(', LaunchConfiguration('n'), ')]'])),
    ])
