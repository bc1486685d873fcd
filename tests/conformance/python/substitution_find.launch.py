# SPDX-License-Identifier: Apache-2.0
"""The folder of a package at once."""

import os

from launch import LaunchDescription
from launch.actions import LogInfo
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackagePrefix, FindPackageShare


def generate_launch_description():
    share = FindPackageShare('demo').find('demo')
    prefix = FindPackagePrefix('demo').find('demo')
    return LaunchDescription([
        LogInfo(msg=share),
        LogInfo(msg=prefix),
        Node(package='demo', executable='talker', parameters=[os.path.join(share, 'config', 'demo.yaml')]),
    ])
