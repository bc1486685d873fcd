# SPDX-License-Identifier: Apache-2.0
"""A substitution of the file that evaluates a condition."""

from launch import LaunchDescription, Substitution
from launch.actions import DeclareLaunchArgument
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration, PythonExpression
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch_ros.actions import Node


class ConditionalText(Substitution):
    def __init__(self, text_if, text_else, condition):
        super().__init__()
        self.text_if = text_if
        self.text_else = text_else
        self.condition = condition

    def perform(self, context):
        if self.condition is None or self.condition._predicate_func(context):
            return perform_substitutions(context, normalize_to_list_of_substitutions(self.text_if))
        return perform_substitutions(context, normalize_to_list_of_substitutions(self.text_else))


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('stereo', default_value='true'),
        DeclareLaunchArgument('depth', default_value=ConditionalText('false', 'true', IfCondition(PythonExpression(
            ["'", LaunchConfiguration('stereo'), "' == 'true'"]))), description='depth'),
        Node(package='demo', executable='talker', parameters=[{'depth': LaunchConfiguration('depth')}]),
    ])
