from launch import LaunchDescription
from launch.actions import (AppendEnvironmentVariable, ExecuteProcess, ReplaceEnvironmentVariables, ResetEnvironment,
                            SetEnvironmentVariable, UnsetEnvironmentVariable)
from launch.substitutions import EnvironmentVariable


def generate_launch_description():
    return LaunchDescription([
        SetEnvironmentVariable('A', '1'),
        AppendEnvironmentVariable('A', '2'),
        AppendEnvironmentVariable('A', '0', prepend=True, separator=','),
        ExecuteProcess(cmd=['first', EnvironmentVariable('A')]),
        UnsetEnvironmentVariable('A'),
        ExecuteProcess(cmd=['second', EnvironmentVariable('A', default_value='none')]),
        ReplaceEnvironmentVariables({'PATH': '/bin', 'B': 'b'}),
        ExecuteProcess(cmd=['third']),
        ResetEnvironment(),
        ExecuteProcess(cmd=['fourth']),
    ])
