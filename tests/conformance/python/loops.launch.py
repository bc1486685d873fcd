# SPDX-License-Identifier: Apache-2.0
"""Nodes that are made in a loop, with values from a file."""

import os
import json

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import GroupAction
from launch_ros.actions import Node, PushRosNamespace, SetRemap


def generate_launch_description():
    with open(os.path.join(get_package_share_directory('demo'), 'config', 'robots.json')) as file:
        robots = json.load(file)
    nodes = []
    for robot in robots:
        nodes.append(GroupAction([
            PushRosNamespace(robot['name']),
            SetRemap('/tf', 'tf'),
            Node(package='demo', executable='talker', parameters=[{'pose': robot['pose'], 'robot': robot['name']}]),
        ]))
    return LaunchDescription([
        *nodes,
    ])
