from nav2_commons.launch import RewrittenYaml


def generate_launch_description():
    return RewrittenYaml()
