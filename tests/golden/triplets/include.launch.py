from launch import LaunchDescription
from launch.actions import (EmitEvent, ExecuteProcess, ForLoop, IncludeLaunchDescription, Log, LogDebug, LogError,
                            LogInfo, LogWarning, TimerAction)
from launch.events import Shutdown
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution, ThisLaunchFileDir
from launch_ros.actions import RosTimer


def generate_launch_description():
    return LaunchDescription([
        IncludeLaunchDescription(
            PythonLaunchDescriptionSource(PathJoinSubstitution([ThisLaunchFileDir(), 'arguments.launch.py'])),
            launch_arguments={'mode': 'robot'}.items()),
        TimerAction(period=3, actions=[LogInfo(msg='later'), EmitEvent(event=Shutdown(reason='enough'))]),
        RosTimer(period=2.5, cancel_on_shutdown=False, actions=[ExecuteProcess(cmd=['soon'])]),
        ForLoop('2', function=lambda i: LogInfo(msg=f'turn {i}')),
        LogWarning(msg='careful'),
        LogError(msg='wrong'),
        LogDebug(msg='detail'),
        Log(msg=LaunchConfiguration('kept'), level='error'),
    ])
