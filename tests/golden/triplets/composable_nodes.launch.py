from launch import LaunchDescription
from launch.conditions import IfCondition
from launch_ros.actions import ComposableNodeContainer, LoadComposableNodes, PushROSNamespace
from launch_ros.descriptions import ComposableLifecycleNode, ComposableNode


def generate_launch_description():
    container = ComposableNodeContainer(
        package='demo_nodes', executable='talker', name='container', namespace='parts', arguments=['--one'],
        composable_node_descriptions=[
            ComposableNode(
                package='composition', plugin='composition::Talker', name='first', namespace='left',
                parameters=[{'rate': 10}], remappings=[('chatter', 'out')],
                extra_arguments=[{'use_intra_process_comms': True}]),
            ComposableNode(package='composition', plugin='composition::Listener', name='off',
                           condition=IfCondition('false')),
        ])
    return LaunchDescription([
        PushROSNamespace('robot'),
        container,
        LoadComposableNodes(
            target_container=container,
            composable_node_descriptions=[
                ComposableNode(package='composition', plugin='composition::Listener', name='second'),
                ComposableLifecycleNode(package='composition', plugin='composition::Managed', name='third',
                                        autostart=True),
            ]),
    ])
