# SPDX-License-Identifier: Apache-2.0
"""Defaults that are no texts become texts."""

from launch import LaunchDescription
from launch.actions import LogInfo
from launch.substitutions import LaunchConfiguration


def generate_launch_description():
    return LaunchDescription([
        LogInfo(msg=[LaunchConfiguration('a', default=1), ' ', LaunchConfiguration('b', default=True), ' ',
                     LaunchConfiguration('c', default=[1, 2]), ' <', LaunchConfiguration('d', default={}), '>']),
    ])
