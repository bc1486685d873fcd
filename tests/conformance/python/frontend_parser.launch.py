# SPDX-License-Identifier: Apache-2.0
"""An XML file that is read by hand."""

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import LogInfo
from launch.frontend import Parser


def generate_launch_description():
    root, parser = Parser.load(get_package_share_directory('demo') + '/launch/two.launch.xml')
    return LaunchDescription([
        LogInfo(msg=f'{root.type_name} {[child.type_name for child in root.children]}'),
        LogInfo(msg=parser.parse_substitution('$(find-pkg-share demo)/x')),
    ])
