# SPDX-License-Identifier: Apache-2.0
"""Handlers of starts, ends, output and the shutdown."""

from launch import LaunchDescription
from launch.actions import ExecuteProcess, LogInfo, RegisterEventHandler
from launch.event_handlers import OnExecutionComplete, OnProcessExit, OnProcessIO, OnProcessStart, OnShutdown
from launch.substitutions import LocalSubstitution


def generate_launch_description():
    first = ExecuteProcess(cmd=['sh', '-c', 'true'], name='first')
    second = ExecuteProcess(cmd=['sh', '-c', 'true'], name='second')
    return LaunchDescription([
        first,
        RegisterEventHandler(OnProcessStart(target_action=first, on_start=[LogInfo(msg='started'), second])),
        RegisterEventHandler(OnProcessExit(target_action=lambda action: action is second, on_exit=lambda event,
                                           context: None)),
        RegisterEventHandler(OnProcessIO(target_action=first,
                                         on_stdout=lambda event: LogInfo(msg=event.text.decode()))),
        RegisterEventHandler(OnExecutionComplete(target_action=second, on_completion=[LogInfo(msg='complete')])),
        RegisterEventHandler(OnShutdown(on_shutdown=[LogInfo(msg=['ends because of ',
                                                                  LocalSubstitution('event.reason')])])),
    ])
