from launch import LaunchDescription
from launch.actions import *  # noqa: F403
from launch.substitutions import *  # noqa: F403
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        OpaqueCoroutine(coroutine=print),
    ])
