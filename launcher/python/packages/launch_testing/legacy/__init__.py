# SPDX-License-Identifier: Apache-2.0
"""The former way of ROS 2's to run tests: a launch service of one's own."""

from launch._values import LaunchFileError


class LaunchTestService:
    """A file may import it; only the launcher runs launch descriptions."""

    def __init__(self, *_args, **_kwargs):
        raise LaunchFileError('a launch file can\'t run a LaunchTestService', 'launch_test FILE runs tests of a launch')
