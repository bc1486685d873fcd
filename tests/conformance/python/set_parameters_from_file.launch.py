# SPDX-License-Identifier: Apache-2.0
"""A file of parameters for all nodes that follow."""

from launch import LaunchDescription
from launch.substitutions import PathJoinSubstitution
from launch_ros.actions import Node, SetParametersFromFile
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    return LaunchDescription([
        SetParametersFromFile(PathJoinSubstitution([FindPackageShare('demo'), 'config', 'demo.yaml'])),
        Node(package='demo', executable='talker', parameters=[{'b': 1}]),
    ])
