# SPDX-License-Identifier: Apache-2.0
"""Programs that conditions leave out."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess
from launch.conditions import IfCondition, UnlessCondition
from launch.substitutions import LaunchConfiguration


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('record', default_value='false'),
        ExecuteProcess(cmd=['sh', '-c', 'record'], condition=IfCondition(LaunchConfiguration('record'))),
        ExecuteProcess(cmd=['sh', '-c', 'play'], condition=UnlessCondition(LaunchConfiguration('record'))),
    ])
