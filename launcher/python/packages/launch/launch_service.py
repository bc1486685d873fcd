# SPDX-License-Identifier: Apache-2.0
"""The class that runs launch descriptions in ROS 2. Here only the launcher itself runs them."""

from launch import _names
from launch._values import LaunchFileError


class LaunchService:

    def __init__(self, *_args, **_kwargs):
        raise LaunchFileError('a launch file can\'t run a LaunchService: it runs in one already',
                              'include launch files with IncludeLaunchDescription')


class LaunchIntrospector:

    def __init__(self, *_args, **_kwargs):
        raise LaunchFileError('there is no LaunchIntrospector here', 'launch --dry-run shows what would be done')


_names.same_module(__name__, 'launch.launch_introspector')
