# SPDX-License-Identifier: Apache-2.0
"""An expression that has an error."""

from launch import LaunchDescription
from launch.actions import LogInfo
from launch.substitutions import PythonExpression


def generate_launch_description():
    return LaunchDescription([
        LogInfo(msg=PythonExpression(['1 +'])),
    ])
