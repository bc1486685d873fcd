# SPDX-License-Identifier: Apache-2.0
"""An action whose visit the file overrides."""

from launch import Action, LaunchDescription
from launch.actions import LogInfo
from launch.conditions import IfCondition


class Twice(Action):
    def visit(self, context):
        return [LogInfo(msg='once'), LogInfo(msg='twice')]


def generate_launch_description():
    return LaunchDescription([
        Twice(condition=IfCondition('false')),
    ])
