# SPDX-License-Identifier: Apache-2.0
"""A bring-up file as robots have it."""

import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, GroupAction, IncludeLaunchDescription, SetEnvironmentVariable
from launch.conditions import IfCondition
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PythonExpression
from launch_ros.actions import Node, PushRosNamespace


def generate_launch_description():
    share = get_package_share_directory('demo')
    use_sim_time = LaunchConfiguration('use_sim_time')
    namespace = LaunchConfiguration('namespace')
    remappings = [('/tf', 'tf'), ('/tf_static', 'tf_static')]
    description = LaunchDescription()
    for action in (
            SetEnvironmentVariable('RCUTILS_LOGGING_BUFFERED_STREAM', '1'),
            DeclareLaunchArgument('namespace', default_value='', description='Top-level namespace'),
            DeclareLaunchArgument('use_sim_time', default_value='false', description='Use the simulated clock'),
            DeclareLaunchArgument('use_rviz', default_value='True'),
            DeclareLaunchArgument('params_file', default_value=os.path.join(share, 'config', 'demo.yaml')),
            DeclareLaunchArgument('log_level', default_value='info')):
        description.add_action(action)
    description.add_action(GroupAction([
        PushRosNamespace(condition=IfCondition(PythonExpression(["'", namespace, "' != ''"])), namespace=namespace),
        Node(package='demo', executable='talker', name='controller', output='screen', respawn=False,
             respawn_delay=2.0,
             parameters=[LaunchConfiguration('params_file'), {'use_sim_time': use_sim_time}],
             arguments=['--ros-args', '--log-level', LaunchConfiguration('log_level')], remappings=remappings),
        IncludeLaunchDescription(PythonLaunchDescriptionSource(os.path.join(share, 'launch', 'one.launch.py')),
                                 launch_arguments={'use_sim_time': use_sim_time, 'name': 'localization'}.items()),
    ]))
    description.add_action(Node(condition=IfCondition(LaunchConfiguration('use_rviz')), package='demo',
                                executable='talker',
                                name='rviz', arguments=['-d', os.path.join(share, 'rviz', 'demo.rviz')]))
    return description
