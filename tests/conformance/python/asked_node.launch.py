# SPDX-License-Identifier: Apache-2.0
"""What a node is made of."""

from launch import LaunchDescription
from launch.actions import LogInfo
from launch_ros.actions import Node


def generate_launch_description():
    node = Node(package='demo', executable='talker', name='n', parameters=[{'a': 1}])
    try:
        name = node.node_name
    except RuntimeError as error:
        name = str(error)
    return LaunchDescription([
        LogInfo(msg=f'{node.node_package} {node.node_executable} {name}'),
        node,
    ])
