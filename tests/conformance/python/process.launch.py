# SPDX-License-Identifier: Apache-2.0
"""Programs with arguments of all kinds."""

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import ExecuteProcess, SetLaunchConfiguration
from launch.substitutions import FindExecutable, LaunchConfiguration


def generate_launch_description():
    return LaunchDescription([
        SetLaunchConfiguration('w', 'two words'),
        ExecuteProcess(cmd=['echo', 'a', LaunchConfiguration('w'), ['x=', LaunchConfiguration('w')]]),
        ExecuteProcess(cmd=[FindExecutable(name='env'), '-i'], name='clean', output='both'),
        ExecuteProcess(cmd=[['echo ', LaunchConfiguration('w'), ' | cat']], shell=True),
        ExecuteProcess(cmd=['sh', '-c', 'true'], cwd=get_package_share_directory('demo'), additional_env={'A': 'B'}),
        ExecuteProcess(cmd=['ls'], prefix='time'),
    ])
