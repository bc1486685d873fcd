# SPDX-License-Identifier: Apache-2.0
"""The environment of one node."""

from launch import LaunchDescription
from launch.substitutions import EnvironmentVariable
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(package='demo', executable='talker',
             additional_env={'A': '1', 'B': ['x', EnvironmentVariable('USER')]}),
        Node(package='demo', executable='talker', env={'ONLY': 'this'}),
        Node(package='demo', executable='talker', cwd='/tmp'),
    ])
