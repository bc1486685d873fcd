# SPDX-License-Identifier: Apache-2.0
"""The class that runs launch descriptions: in a Python program, and not in a launch file, which runs in one already."""

import _launch_engine
from launch import _names
from launch._values import LaunchFileError

if hasattr(_launch_engine, 'IS_PROGRAM'):  # this is a Python program of the user's, not the launcher
    from launch._script._service import LaunchService
else:
    class LaunchService:

        def __init__(self, *_args, **_kwargs):
            raise LaunchFileError('a launch file can\'t run a LaunchService: it runs in one already',
                                  'include launch files with IncludeLaunchDescription')


class LaunchIntrospector:

    def __init__(self, *_args, **_kwargs):
        raise LaunchFileError('there is no LaunchIntrospector here', 'launch --dry-run shows what would be done')


_names.same_module(__name__, 'launch.launch_introspector')
__all__ = ['LaunchIntrospector', 'LaunchService']
