# SPDX-License-Identifier: Apache-2.0
"""A substitution that writes a parameter file and gives its path."""

import yaml
import tempfile

from launch import LaunchDescription, Substitution
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch_ros.actions import Node
from launch_ros.descriptions import ParameterFile
from launch_ros.substitutions import FindPackageShare


class Rewritten(Substitution):
    def __init__(self, source, values):
        super().__init__()
        self.source = normalize_to_list_of_substitutions(source)
        self.values = {key: normalize_to_list_of_substitutions(value) for key, value in values.items()}

    def describe(self):
        return ''

    def perform(self, context):
        with open(perform_substitutions(context, self.source)) as file:
            data = yaml.safe_load(file)
        for key, value in self.values.items():
            data['/**']['ros__parameters'][key] = yaml.safe_load(perform_substitutions(context, value))
        with tempfile.NamedTemporaryFile('w', delete=False, suffix='.yaml') as file:
            yaml.dump(data, file)
        return file.name


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('rate', default_value='50'),
        Node(package='demo', executable='talker', parameters=[ParameterFile(
            Rewritten(PathJoinSubstitution([FindPackageShare('demo'), 'config', 'demo.yaml']),
                      {'rate': LaunchConfiguration('rate')}),
            allow_substs=True)]),
    ])
