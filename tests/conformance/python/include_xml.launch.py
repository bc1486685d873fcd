# SPDX-License-Identifier: Apache-2.0
"""An included XML file."""

import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription, LogInfo
from launch.substitutions import LaunchConfiguration
from launch_xml.launch_description_sources import XMLLaunchDescriptionSource


def generate_launch_description():
    return LaunchDescription([
        IncludeLaunchDescription(XMLLaunchDescriptionSource(os.path.join(get_package_share_directory('demo'),
                                                                         'launch/two.launch.xml')),
                                 launch_arguments={'name': 'from_python'}.items()),
        LogInfo(msg=['the file has set ', LaunchConfiguration('set_by_xml')]),
    ])
