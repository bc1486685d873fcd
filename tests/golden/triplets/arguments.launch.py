from launch import LaunchDescription
from launch.actions import (DeclareBooleanLaunchArgument, DeclareLaunchArgument, LogInfo, ResetLaunchConfigurations,
                            SetLaunchConfiguration, UnsetLaunchConfiguration)
from launch.substitutions import LaunchConfiguration


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('mode', default_value='sim', description='where it runs', choices=['sim', 'robot']),
        DeclareBooleanLaunchArgument('verbose', default_value=False),
        SetLaunchConfiguration('greeting', ['hello ', LaunchConfiguration('mode')]),
        LogInfo(msg=LaunchConfiguration('greeting')),
        UnsetLaunchConfiguration('greeting'),
        LogInfo(msg=LaunchConfiguration('greeting', default='none')),
        ResetLaunchConfigurations({'kept': LaunchConfiguration('mode')}),
        LogInfo(msg=[LaunchConfiguration('kept'), ' ', LaunchConfiguration('mode', default='gone')]),
    ])
