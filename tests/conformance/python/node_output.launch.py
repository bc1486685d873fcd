# SPDX-License-Identifier: Apache-2.0
"""Options that change how a node runs."""

from launch import LaunchDescription
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(package='demo', executable='talker', output='screen', emulate_tty=True, respawn=True,
             respawn_delay=2.0,
             sigterm_timeout='10', sigkill_timeout='5', prefix='nice -n 5'),
        Node(package='demo', executable='talker', output={'both': {'screen', 'log', 'own_log'}}),
        Node(package='demo', executable='talker', output={'stdout': 'screen', 'stderr': 'log'},
             prefix=['stdbuf -o ', 'L']),
        Node(package='demo', executable='talker', respawn=LaunchConfiguration('respawn', default='false')),
    ])
