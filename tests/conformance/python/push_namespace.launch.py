# SPDX-License-Identifier: Apache-2.0
"""Namespaces that are pushed on each other."""

from launch import LaunchDescription
from launch.actions import GroupAction
from launch_ros.actions import Node, PushROSNamespace, PushRosNamespace


def generate_launch_description():
    return LaunchDescription([
        PushRosNamespace('a'),
        Node(package='demo', executable='talker', name='one'),
        GroupAction([PushROSNamespace('b'), Node(package='demo', executable='talker', name='two', namespace='c')]),
        Node(package='demo', executable='talker', name='three', namespace='/d'),
        GroupAction([PushRosNamespace('/e'), Node(package='demo', executable='talker', name='four')]),
    ])
