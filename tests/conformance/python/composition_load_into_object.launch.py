# SPDX-License-Identifier: Apache-2.0
"""Nodes that are loaded into a container by its object."""

from launch import LaunchDescription
from launch_ros.actions import ComposableNodeContainer, LoadComposableNodes, SetParameter, SetRemap
from launch_ros.descriptions import ComposableNode


def generate_launch_description():
    container = ComposableNodeContainer(name='c', namespace='n', package='rclcpp_components',
                                        executable='component_container')
    return LaunchDescription([
        SetParameter('use_sim_time', True),
        SetRemap('a', 'b'),
        container,
        LoadComposableNodes(target_container=container, composable_node_descriptions=[
            ComposableNode(package='demo', plugin='demo::Talker', name='one'),
            ComposableNode(package='demo', plugin='demo::Talker', name='two')]),
    ])
