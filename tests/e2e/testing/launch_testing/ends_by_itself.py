# SPDX-License-Identifier: Apache-2.0
"""Tests for the time after the shutdown alone, of a process that needs a moment and ends by itself."""

import unittest

from launch import LaunchDescription
from launch.actions import ExecuteProcess
from launch_testing import post_shutdown_test
from launch_testing.actions import ReadyToTest
from launch_testing.asserts import assertExitCodes, assertInStdout


def generate_test_description():
    slow = ExecuteProcess(cmd=['sh', '-c', 'sleep 0.5; echo written'])
    return LaunchDescription([slow, ReadyToTest()]), {'slow': slow}


@post_shutdown_test()
class TestAfter(unittest.TestCase):

    def test_it_has_written(self, proc_output, slow):
        assertInStdout(proc_output, 'written', slow)

    def test_it_has_ended_well(self, proc_info):
        assertExitCodes(proc_info, allowable_exit_codes=[0])
