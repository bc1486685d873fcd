# SPDX-License-Identifier: Apache-2.0
"""How long a launch without active tests waits for processes that end by themselves."""

import os
import subprocess
import sys
import threading
import unittest

sys.path.insert(0, os.environ['LAUNCH_PACKAGES'])

from launch_testing import _time_to_end  # noqa: E402


class TimeToEndTest(unittest.TestCase):

    def setUp(self):
        self.now = 0.0
        self.groups = {}
        for name, fake in (('time', self), ('_groups', lambda: self.groups)):
            self.addCleanup(setattr, _time_to_end, name, getattr(_time_to_end, name))
            setattr(_time_to_end, name, fake)
        self.time_to_end = _time_to_end.TimeToEnd()

    def monotonic(self):
        return self.now

    def looks_until_it_is_over(self, running, seconds_of_a_look=_time_to_end.LOOK, most=1000):
        for count in range(1, most):
            self.now += seconds_of_a_look
            if self.time_to_end.is_over(running):
                return count
        return None

    def test_a_process_that_sleeps_has_two_seconds(self):
        self.groups = {7: (0.0, False)}
        self.assertIn(self.looks_until_it_is_over({7}), (40, 41))

    def test_no_time_passes_for_a_process_that_waits_for_a_processor(self):
        self.groups = {7: (0.01, True)}
        self.assertIsNone(self.looks_until_it_is_over({7}))

    def test_a_process_that_runs_has_two_seconds_of_running(self):
        self.groups = {7: (1.9, True)}
        self.assertIsNone(self.looks_until_it_is_over({7}))
        self.groups = {7: (2.0, True)}
        self.assertEqual(self.looks_until_it_is_over({7}), 1)

    def test_all_processes_have_their_time(self):
        self.groups = {7: (0.0, False), 8: (0.0, True)}
        self.assertIsNone(self.looks_until_it_is_over({7, 8}))

    def test_a_look_that_comes_late_counts_as_two(self):
        self.groups = {7: (0.0, False)}
        self.assertIn(self.looks_until_it_is_over({7}, seconds_of_a_look=100.0), (20, 21))

    def test_a_launch_without_processes(self):
        self.assertIn(self.looks_until_it_is_over(set()), (40, 41))


class GroupsTest(unittest.TestCase):

    def test_groups_of_this_machine(self):
        with subprocess.Popen(['sh', '-c', 'echo here; read word'], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                              start_new_session=True) as process:
            process.stdout.readline()
            self.assertGreaterEqual(_time_to_end._groups()[process.pid][0], 0.0)
            process.stdin.close()
        none_is_left = threading.Event()
        none_is_left.set()
        _time_to_end.TimeToEnd().wait(none_is_left, set)


if __name__ == '__main__':
    unittest.main()
