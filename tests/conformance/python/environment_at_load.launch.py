# SPDX-License-Identifier: Apache-2.0
"""An environment that a file changes while it is loaded."""

import os

from launch import LaunchDescription
from launch.actions import ExecuteProcess
from launch.substitutions import EnvironmentVariable


def generate_launch_description():
    os.environ['LOADED'] = 'yes'
    return LaunchDescription([
        ExecuteProcess(cmd=['echo', EnvironmentVariable('LOADED')]),
    ])
