# SPDX-License-Identifier: Apache-2.0
"""Events that ask something of a process."""

from launch import LaunchDescription
from launch.actions import EmitEvent, TimerAction
from launch.events import matches_action
from launch.events.process import ShutdownProcess, SignalProcess
from launch_ros.actions import Node


def generate_launch_description():
    node = Node(package='demo', executable='talker', name='n')
    return LaunchDescription([
        node,
        TimerAction(period=5.0,
                    actions=[EmitEvent(event=SignalProcess(signal_number='SIGUSR1',
                                                           process_matcher=matches_action(node)))]),
        TimerAction(period=10.0, actions=[EmitEvent(event=ShutdownProcess(process_matcher=matches_action(node)))]),
    ])
