# SPDX-License-Identifier: Apache-2.0
"""
Tests of launched systems as tests of pytest, as ROS 2's package of this name has them.

The launch runs in pytest's own process (launch.LaunchService); docs/launch_testing.md lists the names.
"""

from launch_pytest import actions, tools
from launch_pytest.fixture import fixture

__all__ = ['actions', 'fixture', 'tools']
