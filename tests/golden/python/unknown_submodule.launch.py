import launch.parsing


def generate_launch_description():
    return launch.parsing
