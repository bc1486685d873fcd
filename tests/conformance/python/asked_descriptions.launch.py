# SPDX-License-Identifier: Apache-2.0
"""How substitutions describe themselves."""

from launch import LaunchDescription
from launch.actions import LogInfo
from launch.substitutions import (
    AnonName, Command, EnvironmentVariable, FindExecutable, LaunchConfiguration, PathJoinSubstitution,
    PythonExpression, TextSubstitution, ThisLaunchFile, ThisLaunchFileDir)
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    described = [part.describe() for part in [
        LaunchConfiguration('a'), LaunchConfiguration(['a', 'b']), EnvironmentVariable('HOME'),
        FindExecutable(name='ls'),
        TextSubstitution(text='t'), PythonExpression(['1', '+1']), Command('ls'), ThisLaunchFile(),
        ThisLaunchFileDir(),
        AnonName('n'), PathJoinSubstitution(['a', 'b']), FindPackageShare('demo')]]
    return LaunchDescription([
        LogInfo(msg='; '.join(described)),
    ])
