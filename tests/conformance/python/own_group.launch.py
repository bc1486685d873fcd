# SPDX-License-Identifier: Apache-2.0
"""A group that the file derives."""

from launch import LaunchDescription
from launch.actions import GroupAction
from launch_ros.actions import Node, PushRosNamespace


class Robot(GroupAction):
    def __init__(self, name):
        super().__init__([PushRosNamespace(name), Node(package='demo', executable='talker')])


def generate_launch_description():
    return LaunchDescription([
        *[Robot(f'robot{i}') for i in range(3)],
    ])
