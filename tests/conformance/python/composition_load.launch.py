# SPDX-License-Identifier: Apache-2.0
"""Nodes that are loaded into a container of another file."""

from launch import LaunchDescription
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import LoadComposableNodes, PushRosNamespace
from launch_ros.descriptions import ComposableNode
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    return LaunchDescription([
        PushRosNamespace('robot'),
        LoadComposableNodes(
            target_container='/a/container',
            composable_node_descriptions=[
                ComposableNode(package='demo', plugin='demo::Talker', name='talker', parameters=[
                    PathJoinSubstitution([FindPackageShare('demo'), 'config', 'demo.yaml']), {'text': '7'}])]),
        LoadComposableNodes(
            condition=IfCondition(LaunchConfiguration('more', default='false')),
            target_container=['a/', 'container'],
            composable_node_descriptions=[ComposableNode(package='demo', plugin='demo::Talker')]),
    ])
