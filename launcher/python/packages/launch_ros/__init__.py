# SPDX-License-Identifier: Apache-2.0
"""Launch files in Python: the names of ROS 2's package `launch_ros`, on the launcher that runs this file."""

import launch  # noqa: F401
from launch import _lazy

__all__ = ('actions', 'descriptions', 'event_handlers', 'events', 'parameter_descriptions', 'substitutions', 'utilities')
_MODULES = (*__all__, 'ros_adapters')  # which needs rclpy


def __getattr__(name):
    return _lazy.module(__name__, name, _MODULES)


def __dir__():
    return __all__
