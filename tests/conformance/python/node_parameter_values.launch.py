# SPDX-License-Identifier: Apache-2.0
"""Parameters whose type is told."""

from typing import List

from launch import LaunchDescription
from launch.actions import SetLaunchConfiguration
from launch.substitutions import Command, LaunchConfiguration
from launch_ros.actions import Node
from launch_ros.descriptions import ParameterValue


def generate_launch_description():
    return LaunchDescription([
        SetLaunchConfiguration('n', '7'),
        Node(package='demo', executable='talker', parameters=[{
            'text': ParameterValue(LaunchConfiguration('n'), value_type=str),
            'real': ParameterValue(LaunchConfiguration('n'), value_type=float),
            'whole': ParameterValue(LaunchConfiguration('n'), value_type=int),
            'yes': ParameterValue(LaunchConfiguration('yes', default='1'), value_type=bool),
            'list': ParameterValue(LaunchConfiguration('list', default='[a, b]'), value_type=List[str]),
            'description': ParameterValue(Command(['echo ', '<robot/>']), value_type=str)}]),
    ])
