# SPDX-License-Identifier: Apache-2.0
"""Nodes that are processes or components."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, GroupAction
from launch.conditions import IfCondition, UnlessCondition
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import LoadComposableNodes, Node, SetParameter
from launch_ros.descriptions import ComposableNode


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('composed', default_value='true'),
        GroupAction(condition=UnlessCondition(LaunchConfiguration('composed')),
                    actions=[Node(package='demo', executable='talker')]),
        GroupAction(condition=IfCondition(LaunchConfiguration('composed')), actions=[
            SetParameter('rate', 4),
            Node(name='container', package='rclcpp_components', executable='component_container_isolated'),
            LoadComposableNodes(target_container=['', '/', 'container'], composable_node_descriptions=[
                ComposableNode(package='demo', plugin='demo::Talker', name='talker')])]),
    ])
