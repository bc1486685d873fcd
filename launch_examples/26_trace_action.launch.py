"""The Trace action as ros2_tracing has it: `ros2 launch` runs this file with any two nodes."""

from launch import LaunchDescription
from launch.actions import Shutdown
from launch_ros.actions import Node
from tracetools_launch.action import Trace


def generate_launch_description():
    return LaunchDescription([
        Trace(
            session_name='trace_action',
            append_timestamp=True,
            events_ust=['ros2:*', 'lttng_ust_libc:malloc'],
            context_fields={'userspace': ['procname', 'vpid', 'vtid'], 'kernel': []}),
        Node(package='demo_nodes', executable='pong'),
        Node(package='demo_nodes', executable='ping', parameters=[{'count': 5}], on_exit=Shutdown()),
    ])
