# SPDX-License-Identifier: Apache-2.0
"""A function that reads a file of parameters."""

import os
import yaml

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def launch_setup(context):
    path = os.path.join(get_package_share_directory('demo'), 'config', LaunchConfiguration('file').perform(context))
    with open(path) as file:
        parameters = yaml.safe_load(file)['/**']['ros__parameters']
    parameters['rate'] *= 2
    return [Node(package='demo', executable='talker', parameters=[parameters])]


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('file', default_value='demo.yaml'),
        OpaqueFunction(function=launch_setup),
    ])
