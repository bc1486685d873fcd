# SPDX-License-Identifier: Apache-2.0
"""Processes that are tests themselves."""

import unittest

import launch
import launch_testing
import launch_testing.actions
import launch_testing.asserts
import pytest

good = launch_testing.actions.GTest(path='true', timeout=60)
late = launch_testing.actions.Test(cmd=['sleep', '1000'], timeout=0.1)
file = launch_testing.actions.PyTest(path='test_file.py')


@pytest.mark.launch_test
def generate_test_description():
    return launch.LaunchDescription([good, late, launch_testing.actions.ReadyToTest()])


class TestActions(unittest.TestCase):

    def test_a_program_that_passes(self, proc_info):
        proc_info.assertWaitForShutdown(process=good, timeout=60)
        launch_testing.asserts.assertExitCodes(proc_info, process=good)

    def test_a_program_that_takes_too_long(self, proc_info):
        proc_info.assertWaitForShutdown(process=late, timeout=60)
        launch_testing.asserts.assertExitCodes(proc_info, process=late, allowable_exit_codes=[-9])

    def test_their_words(self):
        self.assertEqual(good.timeout, 60)
        self.assertEqual(file.path, 'test_file.py')
        self.assertEqual(len(file.cmd), 4)
