"""Python, which includes XML, which includes YAML; each records a trace of the one system."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription, LogInfo, OpaqueFunction, Shutdown
from launch.launch_description_sources import XMLLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution, ThisLaunchFileDir
from launch_ros.actions import Node
from tracetools_launch.action import Trace


def add_pings(context):
    """What no tag can say: as many nodes as an argument asks for. The launch ends with the first."""
    pairs = int(LaunchConfiguration('pairs').perform(context))
    return [
        Node(
            package='demo_nodes', executable='ping', namespace=f'pair_{number}',
            parameters=[{'count': LaunchConfiguration('count'), 'period_ms': 50}],
            on_exit=Shutdown() if number == 0 else None)
        for number in range(pairs)
    ]


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('pairs', default_value='1', description='how many pairs of ping and pong'),
        DeclareLaunchArgument('count', default_value='10', description='how many messages each ping sends'),
        Trace(session_name='from_python', append_timestamp=True, subbuffer_size_ust=1048576),
        IncludeLaunchDescription(
            XMLLaunchDescriptionSource(PathJoinSubstitution([ThisLaunchFileDir(), '13_python_part.launch.xml'])),
            launch_arguments={'pairs': LaunchConfiguration('pairs')}.items()),
        OpaqueFunction(function=add_pings),
        LogInfo(msg=['pairs: ', LaunchConfiguration('pairs')]),
    ])
