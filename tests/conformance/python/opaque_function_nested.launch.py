# SPDX-License-Identifier: Apache-2.0
"""A function that gives functions and descriptions."""

from launch import LaunchDescription
from launch.actions import LogInfo, OpaqueFunction


def generate_launch_description():
    return LaunchDescription([
        OpaqueFunction(function=lambda context: [
            LogInfo(msg='1'),
            OpaqueFunction(function=lambda context: [LogInfo(msg='2'), LaunchDescription([LogInfo(msg='3')])]),
            LogInfo(msg='4'),
        ]),
    ])
