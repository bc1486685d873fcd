# SPDX-License-Identifier: Apache-2.0
"""Conditions that a file asks itself."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, LogInfo, OpaqueFunction
from launch.conditions import IfCondition, UnlessCondition, evaluate_condition_expression
from launch.substitutions import LaunchConfiguration


def generate_launch_description():
    def ask(context):
        condition = IfCondition(LaunchConfiguration('sim'))
        return [LogInfo(msg=f'{condition.evaluate(context)} {condition._predicate_func(context)} '
                            f'{UnlessCondition("1").evaluate(context)} '
                            f'{evaluate_condition_expression(context, [LaunchConfiguration("sim")])}')]
    return LaunchDescription([
        DeclareLaunchArgument('sim', default_value='true'),
        OpaqueFunction(function=ask),
    ])
