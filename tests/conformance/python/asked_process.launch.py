# SPDX-License-Identifier: Apache-2.0
"""What a process is made of, and a command that is extended."""

from launch import LaunchDescription
from launch.actions import ExecuteProcess, LogInfo
from launch.substitutions import TextSubstitution


def generate_launch_description():
    process = ExecuteProcess(cmd=['echo', ['a', 'b']], name='said', shell=False, output='screen')
    process.cmd.append([TextSubstitution(text='more')])
    words = [''.join(part.describe() for part in word) for word in process.cmd]
    return LaunchDescription([
        LogInfo(msg=' '.join(words)),
        LogInfo(msg=f'{process.shell} {process.process_details} {process.get_sub_entities()} {process.condition}'),
        process,
    ])
