# SPDX-License-Identifier: Apache-2.0
"""What substitutions are made of."""

from launch import LaunchDescription
from launch.actions import LogInfo
from launch.substitutions import (
    Command, EnvironmentVariable, EqualsSubstitution, LaunchConfiguration, NotSubstitution, PythonExpression,
    TextSubstitution)
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    name = LaunchConfiguration(['a', '_b']).variable_name
    variable = EnvironmentVariable('HOME', default_value='none')
    expression = PythonExpression(['1 + ', LaunchConfiguration('n')])
    texts = [''.join(part.describe() for part in parts) for parts in (
        name, variable.name, variable.default_value, expression.expression, Command(['ls ', '-l']).command,
        FindPackageShare('demo').package, NotSubstitution('true').value, EqualsSubstitution('a', 'b').right)]
    return LaunchDescription([
        LogInfo(msg=' '.join(texts)),
        LogInfo(msg=TextSubstitution(text='text').text),
    ])
