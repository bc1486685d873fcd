"""The example of ros2_tracing for its Trace action: the names and values of its example.launch.py."""

import launch
from launch_ros.actions import Node
from tracetools_launch.action import Trace


def generate_launch_description():
    return launch.LaunchDescription([
        Trace(
            session_name='my-tracing-session',
        ),
        Node(
            package='test_tracetools',
            executable='test_ping',
            output='screen',
        ),
        Node(
            package='test_tracetools',
            executable='test_pong',
            output='screen',
        ),
    ])
