# SPDX-License-Identifier: Apache-2.0
"""
Tests of launched systems, as ROS 2's package of this name has them. `launch_test FILE` runs a file of such tests.

The names and arguments are those of ROS 2's launch_testing; docs/launch_testing.md lists them.
"""

try:
    import _launch_engine  # noqa: F401
except ModuleNotFoundError:
    # Outside of the launcher there is the program alone: python3 -m launch_testing.
    pass
else:
    from launch_testing import actions, asserts, markers, tools, util
    from launch_testing._decorators import parametrize, post_shutdown_test, ready_to_test_action_timeout
    from launch_testing.io_handler import ActiveIoHandler, IoHandler
    from launch_testing.proc_info_handler import ActiveProcInfoHandler, ProcInfoHandler
    from launch_testing.ready_aggregator import ReadyAggregator

__all__ = ['ActiveIoHandler', 'ActiveProcInfoHandler', 'IoHandler', 'ProcInfoHandler', 'ReadyAggregator', 'actions',
           'asserts', 'markers', 'parametrize', 'post_shutdown_test', 'ready_to_test_action_timeout', 'tools', 'util']
