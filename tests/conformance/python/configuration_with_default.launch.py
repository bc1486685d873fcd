# SPDX-License-Identifier: Apache-2.0
"""A configuration that nobody declares, with a default."""

from launch import LaunchDescription
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(package='demo', executable='talker',
             parameters=[{'use_sim_time': LaunchConfiguration('use_sim_time', default='false')}]),
    ])
