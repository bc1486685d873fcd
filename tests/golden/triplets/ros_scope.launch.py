from launch import LaunchDescription
from launch.actions import GroupAction, LogInfo, SetLaunchConfiguration
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import (Node, PushRosNamespace, SetParameter, SetRemap, SetROSLogDir, SetUseSimTime)
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import Parameter


def generate_launch_description():
    return LaunchDescription([
        GroupAction([
            PushRosNamespace('robot'),
            SetParameter('use_sim_time', ParameterValue(True)),
            SetParameter('names', ['1', 'b']),
            SetRemap('/tf', 'tf'),
            SetROSLogDir('/var/log/robot'),
            SetUseSimTime(False),
            Node(package='demo_nodes', executable='talker', name='a'),
            LogInfo(msg=Parameter('use_sim_time')),
        ]),
        GroupAction(
            forwarding=False, launch_configurations={'kept': LaunchConfiguration('outer', default='1')},
            actions=[
                Node(package='demo_nodes', executable='talker', name='b'),
                LogInfo(msg=LaunchConfiguration('kept')),
            ]),
        GroupAction([SetLaunchConfiguration('outer', '2')], scoped=False),
        LogInfo(msg=LaunchConfiguration('outer')),
    ])
