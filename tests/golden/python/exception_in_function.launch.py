from launch import LaunchDescription
from launch.actions import OpaqueFunction


def half_of(number):
    return number / 0


def setup(context):
    return [half_of(1)]


def generate_launch_description():
    return LaunchDescription([OpaqueFunction(function=setup)])
