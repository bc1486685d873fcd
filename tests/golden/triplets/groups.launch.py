from launch import LaunchDescription
from launch.actions import GroupAction, IncludeLaunchDescription, LogInfo
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution, ThisLaunchFileDir
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        GroupAction([Node(package='demo_nodes', executable='talker')], name='front', ns='robot', memory_max='1G', memory_high='800M',
                    cpu_quota='150%', cpu_weight=50, io_weight=200, pids_max=100),
        IncludeLaunchDescription(PathJoinSubstitution([ThisLaunchFileDir(), 'parts', 'sets_mode.launch.xml']), scoped=True),
        LogInfo(msg=LaunchConfiguration('mode', default='unset')),
    ])
