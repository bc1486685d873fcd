# SPDX-License-Identifier: Apache-2.0
"""Names and namespaces of nodes."""

from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(package='demo', executable='talker'),
        Node(package='demo', executable='talker', name='named'),
        Node(package='demo', executable='talker', name='named', namespace='below'),
        Node(package='demo', executable='talker', namespace='/absolute'),
        Node(package='demo', executable='talker', name='n', namespace=''),
        Node(package='demo', executable='talker', exec_name='another'),
    ])
