# SPDX-License-Identifier: Apache-2.0
"""The actions of a group."""

from launch import LaunchDescription
from launch.actions import GroupAction, LogInfo


def generate_launch_description():
    group = GroupAction([LogInfo(msg='a'), LogInfo(msg='b')], scoped=False)
    return LaunchDescription([
        LogInfo(msg=str(len(list(group.get_sub_entities())))),
        group,
    ])
