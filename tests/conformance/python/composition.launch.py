# SPDX-License-Identifier: Apache-2.0
"""A container with nodes."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import ComposableNodeContainer
from launch_ros.descriptions import ComposableNode


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('rate', default_value='3'),
        ComposableNodeContainer(
            name='container', namespace='', package='rclcpp_components', executable='component_container_mt',
            output='screen',
            composable_node_descriptions=[
                ComposableNode(package='demo', plugin='demo::Talker', name='talker',
                               parameters=[{'rate': LaunchConfiguration('rate')}]),
                ComposableNode(package='demo', plugin='demo::Listener', namespace='below',
                               remappings=[('chatter', '/said')],
                               extra_arguments=[{'use_intra_process_comms': True}]),
                ComposableNode(package='demo', plugin='demo::Other', name='other', condition=IfCondition('false')),
            ]),
    ])
