from launch import LaunchDescription
from launch.actions import ExecuteProcess, GroupAction


def generate_launch_description():
    return LaunchDescription([
        GroupAction(
            [ExecuteProcess(cmd=['true'])],
            cpu_quota='much',
        ),
    ])
