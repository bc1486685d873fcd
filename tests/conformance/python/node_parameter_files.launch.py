# SPDX-License-Identifier: Apache-2.0
"""Files of parameters, by text, path and substitution."""

import os
from pathlib import Path

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.substitutions import PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.descriptions import ParameterFile
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    return LaunchDescription([
        Node(package='demo', executable='talker', parameters=[
            os.path.join(get_package_share_directory('demo'), 'config', 'demo.yaml'),
            Path(get_package_share_directory('demo')) / 'config' / 'demo.yaml',
            PathJoinSubstitution([FindPackageShare('demo'), 'config', 'demo.yaml']),
            [FindPackageShare('demo'), '/config/', 'demo.yaml'],
            {'rate': 5},
            ParameterFile(PathJoinSubstitution([FindPackageShare('demo'), 'config', 'demo.yaml']))]),
    ])
