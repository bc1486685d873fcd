# SPDX-License-Identifier: Apache-2.0
"""A launch that ends at once."""

from launch import LaunchDescription
from launch.actions import LogInfo, Shutdown


def generate_launch_description():
    return LaunchDescription([
        LogInfo(msg='before'),
        Shutdown(reason='nothing to do'),
        LogInfo(msg='after'),
    ])
