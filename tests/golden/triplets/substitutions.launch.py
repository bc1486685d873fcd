from launch import LaunchDescription
from launch.actions import LogInfo, SetLaunchConfiguration
from launch.substitutions import (
    AllSubstitution, AndSubstitution, AnySubstitution, Command, EqualsSubstitution, FileContent, FindExecutable,
    IfElseSubstitution, LaunchConfiguration, NotEqualsSubstitution, NotSubstitution, OrSubstitution,
    PathJoinSubstitution, PythonExpression, StringJoinSubstitution, TextSubstitution, ThisLaunchFileDir)
from launch_ros.substitutions import ExecutableInPackage, FindPackagePrefix, FindPackageShare


def spaced(*parts):
    message = []
    for part in parts:
        message += [' ', part] if message else [part]
    return LogInfo(msg=message)


def generate_launch_description():
    x = LaunchConfiguration('x')
    return LaunchDescription([
        SetLaunchConfiguration('x', TextSubstitution(text='7')),
        spaced(NotSubstitution('false'), AndSubstitution('true', 'false'), OrSubstitution('true', 'false'),
               AllSubstitution('true', 'true'), AnySubstitution('false', 'false')),
        spaced(EqualsSubstitution(x, 7.0), NotEqualsSubstitution(x, '8'),
               IfElseSubstitution(EqualsSubstitution(x, '7'), 'yes', 'no')),
        spaced(PythonExpression([x, ' * 2']), Command(['echo ', 'hi'])),
        spaced(FindExecutable('sh'), StringJoinSubstitution(['a', x], '-'), PathJoinSubstitution(['a', x]),
               FileContent(PathJoinSubstitution([ThisLaunchFileDir(), ['substitutions', '.txt']]))),
        spaced(FindPackagePrefix('demo_nodes'), FindPackageShare('demo_nodes'),
               ExecutableInPackage('talker', 'demo_nodes')),
        spaced(FindPackageShare('demo_nodes') / 'launch' / ['of_', x], ThisLaunchFileDir() / 'file'),
    ])
