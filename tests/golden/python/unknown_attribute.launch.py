import launch


def generate_launch_description():
    return launch.LaunchDescription([launch.actions.Includelaunchdescription('x')])
