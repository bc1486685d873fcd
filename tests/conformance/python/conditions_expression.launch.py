# SPDX-License-Identifier: Apache-2.0
"""A condition that is an expression."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.conditions import IfCondition, UnlessCondition
from launch.substitutions import LaunchConfiguration, PythonExpression
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('robot', default_value='arm'),
        Node(package='demo', executable='talker', name='a',
             condition=IfCondition(PythonExpression(["'", LaunchConfiguration('robot'), "' == 'arm'"]))),
        Node(package='demo', executable='talker', name='b',
             condition=UnlessCondition(PythonExpression(["'", LaunchConfiguration('robot'), "' == 'arm'"]))),
    ])
