# SPDX-License-Identifier: Apache-2.0
"""Launch files in Python: the names of ROS 2's package `launch_ros`, on the launcher that runs this file."""

import launch  # noqa: F401
from launch_ros import (  # noqa: F401
    actions, descriptions, event_handlers, events, parameter_descriptions, substitutions, utilities)
