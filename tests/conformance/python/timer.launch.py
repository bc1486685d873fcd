# SPDX-License-Identifier: Apache-2.0
"""Nodes that start later."""

from launch import LaunchDescription
from launch.actions import LogInfo, TimerAction
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        TimerAction(period=3.0, actions=[Node(package='demo', executable='talker', name='third')]),
        TimerAction(period='1', actions=[Node(package='demo', executable='talker', name='first')]),
        TimerAction(period=LaunchConfiguration('delay', default='2.0'), actions=[
            LogInfo(msg='second'), Node(package='demo', executable='talker', name='second')]),
        Node(package='demo', executable='talker', name='zeroth'),
    ])
