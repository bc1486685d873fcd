# SPDX-License-Identifier: Apache-2.0
"""The arguments of a description."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, GroupAction, LogInfo


def generate_launch_description():
    inner = LaunchDescription([DeclareLaunchArgument('inner', default_value='1', description='in')])
    description = LaunchDescription([
        DeclareLaunchArgument('a', default_value='x', choices=['x', 'y'], description='the first'),
        GroupAction([DeclareLaunchArgument('b')]),
        DeclareLaunchArgument('b', default_value='late'),
    ])
    names = [argument.name for argument in description.get_launch_arguments()]
    first = description.entities[0]
    description.add_action(LogInfo(msg=' '.join(names)))
    description.add_action(LogInfo(
        msg=f'{first.name} {first.description} {first.choices} {first.default_value[0].describe()}'))
    description.entities.pop(1)
    return description
