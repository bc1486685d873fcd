# SPDX-License-Identifier: Apache-2.0
"""The output of commands."""

from launch import LaunchDescription
from launch.actions import LogInfo
from launch.substitutions import Command, TextSubstitution


def generate_launch_description():
    return LaunchDescription([
        LogInfo(msg=Command('echo text')),
        LogInfo(msg=Command(['echo ', TextSubstitution(text='two words')])),
        LogInfo(msg=Command(['sh -c ', '"echo to stderr >&2; echo out"'], on_stderr='ignore')),
    ])
