# SPDX-License-Identifier: Apache-2.0
"""A file of parameters with substitutions in it."""

from launch import LaunchDescription
from launch.actions import SetLaunchConfiguration
from launch.substitutions import PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.descriptions import ParameterFile
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    return LaunchDescription([
        SetLaunchConfiguration('robot', 'r2'),
        Node(package='demo', executable='talker', parameters=[ParameterFile(
            PathJoinSubstitution([FindPackageShare('demo'), 'config', 'with_substs.yaml']), allow_substs=True)]),
    ])
