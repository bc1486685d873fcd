# SPDX-License-Identifier: Apache-2.0
"""The name of a node that was visited."""

from launch import LaunchDescription
from launch.actions import LogInfo, OpaqueFunction
from launch_ros.actions import Node, PushRosNamespace


def generate_launch_description():
    node = Node(package='demo', executable='talker', name='n', namespace='below')
    return LaunchDescription([
        PushRosNamespace('top'),
        node,
        OpaqueFunction(function=lambda context: [LogInfo(msg=node.node_name)]),
    ])
