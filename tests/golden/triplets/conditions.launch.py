from launch import LaunchDescription
from launch.actions import (DeclareLaunchArgument, ExecuteProcess, IncludeLaunchDescription, LogInfo,
                            RegisterEventHandler, SetLaunchConfiguration)
from launch.conditions import LaunchConfigurationEquals, LaunchConfigurationNotEquals
from launch.event_handlers import OnProcessExit
from launch.launch_description_sources import AnyLaunchDescriptionSource, FrontendLaunchDescriptionSource
from launch.substitutions import (BooleanSubstitution, EqualsSubstitution, LaunchConfiguration, PathSubstitution,
                                  ThisLaunchFileDir)
from launch_ros.actions import ROSTimer
from launch_ros.substitutions import FindPackage, FindPackagePrefix


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('mode', default_value='sim'),
        SetLaunchConfiguration('flag', 'yes'),
        LogInfo(msg='is sim', condition=LaunchConfigurationEquals('mode', 'sim')),
        LogInfo(msg='not reached', condition=LaunchConfigurationEquals('mode', 'real')),
        LogInfo(msg='not real', condition=LaunchConfigurationNotEquals('mode', 'real')),
        LogInfo(msg=BooleanSubstitution(LaunchConfiguration('flag'))),
        LogInfo(msg=PathSubstitution(LaunchConfiguration('mode')) / 'maps' / 'hall.yaml'),
        LogInfo(msg=EqualsSubstitution(FindPackage('demo_nodes'), FindPackagePrefix('demo_nodes'))),
        IncludeLaunchDescription(AnyLaunchDescriptionSource([ThisLaunchFileDir(), '/arguments.launch.yaml']),
                                 launch_arguments=[('mode', 'robot')]),
        IncludeLaunchDescription(FrontendLaunchDescriptionSource([ThisLaunchFileDir(), '/output.launch.xml'])),
        ROSTimer(period=2.5, actions=[ExecuteProcess(cmd=['soon'])]),
        RegisterEventHandler(OnProcessExit(on_exit=[LogInfo(msg='process ended')])),
    ])
