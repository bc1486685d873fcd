# SPDX-License-Identifier: Apache-2.0
"""Conditions made of logical substitutions."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, LogInfo
from launch.conditions import IfCondition
from launch.substitutions import (
    AllSubstitution, AndSubstitution, AnySubstitution, EqualsSubstitution, IfElseSubstitution,
    LaunchConfiguration, NotEqualsSubstitution, NotSubstitution, OrSubstitution)


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('a', default_value='true'),
        DeclareLaunchArgument('b', default_value='False'),
        LogInfo(msg='and',
                condition=IfCondition(AndSubstitution(LaunchConfiguration('a'), LaunchConfiguration('b')))),
        LogInfo(msg='or',
                condition=IfCondition(OrSubstitution(LaunchConfiguration('a'), LaunchConfiguration('b')))),
        LogInfo(msg='not', condition=IfCondition(NotSubstitution(LaunchConfiguration('b')))),
        LogInfo(msg='equals', condition=IfCondition(EqualsSubstitution(LaunchConfiguration('a'), 'true'))),
        LogInfo(msg='not equals', condition=IfCondition(NotEqualsSubstitution(LaunchConfiguration('a'), 'true'))),
        LogInfo(msg=IfElseSubstitution(LaunchConfiguration('a'), 'yes', 'no')),
        LogInfo(msg='any',
                condition=IfCondition(AnySubstitution(LaunchConfiguration('a'), LaunchConfiguration('b')))),
        LogInfo(msg='all',
                condition=IfCondition(AllSubstitution(LaunchConfiguration('a'), LaunchConfiguration('b')))),
    ])
