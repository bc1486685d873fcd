from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch.substitutions import LaunchConfiguration


def setup(context):
    rate = LaunchConfiguration('rat')
    return print(rate.perform(context))


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('rate', default_value='10'),
        OpaqueFunction(function=setup),
    ])
