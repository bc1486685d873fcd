# SPDX-License-Identifier: Apache-2.0
"""A package that is looked for at load, and another way if it is not there."""

from ament_index_python.packages import PackageNotFoundError, get_package_share_directory, get_packages_with_prefixes
from launch import LaunchDescription
from launch.actions import LogInfo


def generate_launch_description():
    try:
        get_package_share_directory('no_such_package')
        text = 'found'
    except PackageNotFoundError:
        text = 'not found'
    return LaunchDescription([
        LogInfo(msg=text),
        LogInfo(msg=str('demo' in get_packages_with_prefixes())),
    ])
