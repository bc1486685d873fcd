from launch import LaunchDescription, LaunchService


def generate_launch_description():
    service = LaunchService()
    service.include_launch_description(LaunchDescription([]))
    return LaunchDescription([])
