# SPDX-License-Identifier: Apache-2.0
"""A handler with a matcher of the file."""

from launch import EventHandler, LaunchDescription
from launch.actions import LogInfo, RegisterEventHandler
from launch.events.process import ProcessStarted
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        RegisterEventHandler(EventHandler(matcher=lambda event: isinstance(event, ProcessStarted),
                                          entities=[LogInfo(msg='started')])),
        Node(package='demo', executable='talker'),
    ])
