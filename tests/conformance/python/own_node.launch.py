# SPDX-License-Identifier: Apache-2.0
"""A node that the file derives."""

from launch import LaunchDescription
from launch.actions import LogInfo
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


class Talker(Node):
    def __init__(self, name, **kwargs):
        super().__init__(package='demo', executable='talker', name=name, parameters=[{'derived': True}], **kwargs)

    def execute(self, context):
        context.launch_configurations['last'] = 'executed'
        return super().execute(context)


def generate_launch_description():
    return LaunchDescription([
        Talker('a'),
        LogInfo(msg=LaunchConfiguration('last')),
        Talker('b', namespace='n'),
    ])
