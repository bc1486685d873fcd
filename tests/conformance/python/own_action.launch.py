# SPDX-License-Identifier: Apache-2.0
"""An action that the file derives."""

from launch import Action, LaunchDescription
from launch.conditions import IfCondition
from launch_ros.actions import Node


class Talkers(Action):
    def __init__(self, count, **kwargs):
        super().__init__(**kwargs)
        self.count = count

    def execute(self, context):
        return [Node(package='demo', executable='talker', name=f't{i}') for i in range(self.count)]


def generate_launch_description():
    return LaunchDescription([
        Talkers(2),
        Talkers(1, condition=IfCondition('false')),
    ])
