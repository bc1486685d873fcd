# SPDX-License-Identifier: Apache-2.0
"""The module that ROS 2 has under this name, too."""

from launch.utilities.type_utils import *  # noqa: F401,F403
