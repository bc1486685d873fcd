# SPDX-License-Identifier: Apache-2.0
"""A name that no release has."""

from launch import LaunchDescription
from launch.actions import LogInfo
from launch.actions import NoSuchAction  # noqa: F401


def generate_launch_description():
    return LaunchDescription([
        LogInfo(msg='never'),
    ])
