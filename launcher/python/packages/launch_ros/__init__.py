"""Launch files in Python: the names of ROS 2's package `launch_ros`, on the launcher that runs this file."""

import launch  # noqa: F401
from launch_ros import actions, descriptions, parameter_descriptions, substitutions, utilities  # noqa: F401
