# SPDX-License-Identifier: Apache-2.0
"""A substitution that the file derives."""

from launch import LaunchDescription, Substitution
from launch.actions import DeclareLaunchArgument, LogInfo
from launch.substitutions import LaunchConfiguration
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch_ros.actions import Node


class Upper(Substitution):
    def __init__(self, text):
        super().__init__()
        self.text = normalize_to_list_of_substitutions(text)

    def describe(self):
        return f'Upper({self.text})'

    def perform(self, context):
        return perform_substitutions(context, self.text).upper()


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('who', default_value=Upper('me')),
        LogInfo(msg=Upper(['it is ', LaunchConfiguration('who')])),
        Node(package='demo', executable='talker', name=Upper('shout')),
    ])
