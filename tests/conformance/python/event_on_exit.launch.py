# SPDX-License-Identifier: Apache-2.0
"""What happens when a process has ended."""

from launch import LaunchDescription
from launch.actions import ExecuteProcess, LogInfo, Shutdown
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(package='demo', executable='talker', on_exit=Shutdown()),
        Node(package='demo', executable='talker',
             on_exit=[LogInfo(msg='ended'), Node(package='demo', executable='talker', name='x')]),
        ExecuteProcess(cmd=['sh', '-c', 'true'], on_exit=lambda event, context: LogInfo(msg='ended')),
    ])
