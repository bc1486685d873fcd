# SPDX-License-Identifier: Apache-2.0
"""Parameters that are evaluated."""

from launch import LaunchDescription
from launch.actions import LogInfo, OpaqueFunction, SetLaunchConfiguration
from launch.substitutions import LaunchConfiguration
from launch_ros.descriptions import Parameter, ParameterValue
from launch_ros.utilities import evaluate_parameters, normalize_parameters


def launch_setup(context):
    parameters = evaluate_parameters(context, normalize_parameters([
        {'a': LaunchConfiguration('n'), 'b': {'c': 'text'}},
        {'d': [1, 2], 'e': ParameterValue(LaunchConfiguration('n'), value_type=str)}]))
    name, value = Parameter('x', LaunchConfiguration('n')).evaluate(context)
    return [LogInfo(msg=f'{parameters} {name} {value!r}')]


def generate_launch_description():
    return LaunchDescription([
        SetLaunchConfiguration('n', '7'),
        OpaqueFunction(function=launch_setup),
    ])
