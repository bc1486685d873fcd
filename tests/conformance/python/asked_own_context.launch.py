# SPDX-License-Identifier: Apache-2.0
"""A context that a file makes itself."""

from launch import LaunchContext, LaunchDescription
from launch.actions import LogInfo
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    context = LaunchContext()
    context.launch_configurations['a'] = 'own'
    text = LaunchConfiguration('a').perform(context)
    return LaunchDescription([
        LogInfo(msg=text),
        LogInfo(msg=PathJoinSubstitution([FindPackageShare('demo'), 'x']).perform(context)),
    ])
