# SPDX-License-Identifier: Apache-2.0
"""A function that changes the configurations and the environment."""

import os

from launch import LaunchDescription
from launch.actions import LogInfo, OpaqueFunction
from launch.substitutions import EnvironmentVariable, LaunchConfiguration
from launch_ros.actions import Node


def launch_setup(context):
    context.launch_configurations['x'] = 'set by the function'
    context.environment['WHO'] = 'function'
    os.environ['ELSE'] = 'too'


def generate_launch_description():
    return LaunchDescription([
        OpaqueFunction(function=launch_setup),
        LogInfo(msg=[LaunchConfiguration('x'), ' ', EnvironmentVariable('WHO')]),
        Node(package='demo', executable='talker'),
    ])
