# SPDX-License-Identifier: Apache-2.0
"""A function that appends to the description that holds it."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch_ros.actions import Node


def launch_setup(context, description):
    description.add_action(Node(package='demo', executable='talker', name=context.launch_configurations['name']))


def generate_launch_description():
    description = LaunchDescription([DeclareLaunchArgument('name', default_value='appended')])
    description.add_action(OpaqueFunction(function=launch_setup, args=[description]))
    return description
