from launch import LaunchDescription
from launch.actions import ForEach, ForLoop, LogInfo
from launch.substitutions import (
    AnonName, EqualsSubstitution, LaunchLogDir, PythonExpression, ThisLaunchFile, ThisLaunchFileDir)
from launch_ros.actions import Node, PushRosNamespace, SetParametersFromFile


def generate_launch_description():
    return LaunchDescription([
        ForEach('{name: a, id: 1};{name: b, id: 2}',
                function=lambda name, id, other='none': LogInfo(msg=f'{name} {id} {other}')),  # noqa: A006
        ForLoop(2, function=lambda i: LogInfo(msg=f'turn {i}')),
        LogInfo(msg=[EqualsSubstitution(AnonName('x'), AnonName('x')), ' ',
                     EqualsSubstitution(LaunchLogDir(), LaunchLogDir())]),
        LogInfo(msg=PythonExpression(['"', ThisLaunchFile(), '".startswith("', ThisLaunchFileDir(), '/loops")'])),
        SetParametersFromFile([ThisLaunchFileDir(), '/parameters.yaml']),
        PushRosNamespace('left'),
        Node(package='demo_nodes', executable='talker', name='talker'),
    ])
