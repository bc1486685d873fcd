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
    from launch import _names
    from launch_testing import actions, asserts, markers, tools, util
    from launch_testing._decorators import parametrize, post_shutdown_test, ready_to_test_action_timeout
    from launch_testing.io_handler import ActiveIoHandler, IoHandler
    from launch_testing.proc_info_handler import ActiveProcInfoHandler, ProcInfoHandler
    from launch_testing.ready_aggregator import ReadyAggregator
    _names.same_module('launch_testing.asserts', *(f'launch_testing.asserts.{name}' for name in (
        'assert_exit_codes', 'assert_output', 'assert_sequential_output')))
    _names.same_module('launch_testing._decorators', *(f'launch_testing.{name}' for name in (
        'decorator', 'parametrize', 'ready_to_test_action_timeout')))
    _names.same_module('launch_testing.actions', 'launch_testing.actions.gtest', 'launch_testing.actions.pytest')
    _names.same_module('launch_testing.util', 'launch_testing.util.proc_lookup')

__all__ = ['ActiveIoHandler', 'ActiveProcInfoHandler', 'IoHandler', 'ProcInfoHandler', 'ReadyAggregator', 'actions',
           'asserts', 'markers', 'parametrize', 'post_shutdown_test', 'ready_to_test_action_timeout', 'tools', 'util']
