# SPDX-License-Identifier: Apache-2.0
"""Conditions on a configuration."""

from launch import LaunchDescription
from launch.actions import SetLaunchConfiguration
from launch.conditions import LaunchConfigurationEquals, LaunchConfigurationNotEquals
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        SetLaunchConfiguration('mode', 'fast'),
        Node(package='demo', executable='talker', name='a', condition=LaunchConfigurationEquals('mode', 'fast')),
        Node(package='demo', executable='talker', name='b', condition=LaunchConfigurationNotEquals('mode', 'fast')),
        Node(package='demo', executable='talker', name='c', condition=LaunchConfigurationEquals('other', None)),
    ])
