# SPDX-License-Identifier: Apache-2.0
"""What a composable node is made of."""

from launch import LaunchDescription
from launch.actions import LogInfo
from launch_ros.actions import ComposableNodeContainer
from launch_ros.descriptions import ComposableNode


def generate_launch_description():
    node = ComposableNode(package='demo', plugin='demo::Talker', name='t', namespace='n', remappings=[('a', 'b')],
                          parameters=[{'rate': 1}], extra_arguments=[{'use_intra_process_comms': True}])
    texts = [node.package[0].describe(), node.node_plugin[0].describe(), node.node_name[0].describe(),
             node.node_namespace[0].describe(), str(node.condition())]
    return LaunchDescription([
        LogInfo(msg=' '.join(texts)),
        ComposableNodeContainer(package='rclcpp_components', executable='component_container', name='c',
                                namespace='',
                                composable_node_descriptions=[node]),
    ])
