# SPDX-License-Identifier: Apache-2.0
"""Functions that give nothing."""

from launch import LaunchDescription
from launch.actions import LogInfo, OpaqueFunction


def generate_launch_description():
    return LaunchDescription([
        OpaqueFunction(function=lambda context: None),
        OpaqueFunction(function=lambda context: []),
        LogInfo(msg='after'),
    ])
