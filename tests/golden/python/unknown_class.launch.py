from launch import LaunchDescription
from launch.actions import ExecuteProces


def generate_launch_description():
    return LaunchDescription([ExecuteProces(cmd=['true'])])
