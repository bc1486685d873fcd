from launch import LaunchDescription
from launch.actions import OpaqueFunction


def setup(context):
    return ['talker']


def generate_launch_description():
    return LaunchDescription([OpaqueFunction(function=setup)])
