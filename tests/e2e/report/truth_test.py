# SPDX-License-Identifier: Apache-2.0
"""What the report says of systems of many kinds is what their traces say."""

import os
import unittest

from truth_case import EXAMPLES, NAMES, TruthCase


class Systems(TruthCase):

    def test_ping_pong(self):
        self.check(self.record(EXAMPLES / '01_ping_pong.launch.xml', 'period_ms:=20'), 8, hops=10)

    def test_names_and_remaps(self):
        self.check(self.record_text(NAMES), 4)

    def test_services(self):
        self.check(self.record_text(f'<include file="{EXAMPLES / "07_services.launch.xml"}"/>'), 1)

    def test_actions(self):
        self.check(self.record(EXAMPLES / '10_action.launch.xml'), 3)

    def test_a_lifecycle(self):
        self.check(self.record(EXAMPLES / '11_lifecycle.launch.xml'), 4)

    def test_many_processes(self):
        self.check(self.record(EXAMPLES / '12_reference_system.launch.xml', 'messages:=10'), 60, hops=500)

    def test_several_threads(self):
        self.check(self.record_text(f'<executable cmd="{os.environ["EXECUTOR_THREADS_WORKER"]}"/>'), 5)

    def test_within_a_process(self):
        self.check(self.record_text(f'<executable cmd="{os.environ["INTRA_PROCESS_WORKER"]}"/>'), 2)

    def test_components(self):
        self.check(self.record(EXAMPLES / '08_composition.launch.xml'), 4, hops=2)

    def test_deadlines(self):
        self.check(self.record(EXAMPLES / '28_deadline.launch.xml'), 1)

    def test_losses_and_filters(self):
        self.check(self.record_text(f'<executable cmd="{os.environ["COUNTING_WORKER"]}"/>', events='ros2:* ros2_ext:*'), 10)

    def test_the_six_problems(self):
        self.check(self.record(EXAMPLES.parent / 'tests/e2e/report/six_problems.launch.xml',
                               f'worker:={os.environ["SIX_PROBLEMS_WORKER"]}'), 30)


if __name__ == '__main__':
    unittest.main()
