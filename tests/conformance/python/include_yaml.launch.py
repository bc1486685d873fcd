# SPDX-License-Identifier: Apache-2.0
"""An included YAML file, and one of any format."""

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import AnyLaunchDescriptionSource, FrontendLaunchDescriptionSource
from launch_yaml.launch_description_sources import YAMLLaunchDescriptionSource


def generate_launch_description():
    return LaunchDescription([
        IncludeLaunchDescription(YAMLLaunchDescriptionSource(get_package_share_directory(
            'demo') + '/launch/three.launch.yaml')),
        IncludeLaunchDescription(AnyLaunchDescriptionSource(get_package_share_directory(
            'demo') + '/launch/two.launch.xml')),
        IncludeLaunchDescription(FrontendLaunchDescriptionSource(get_package_share_directory(
            'demo') + '/launch/two.launch.xml')),
    ])
