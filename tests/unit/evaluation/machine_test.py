# SPDX-License-Identifier: Apache-2.0
"""The description of the machine, and when it counts as busy."""

import os
import tempfile
import unittest
from pathlib import Path

from evaluation import machine
from evaluation.tuning import Tuning


class Jiffies(unittest.TestCase):

    def between(self, before, after, own=0.0):
        ticks = os.sysconf('SC_CLK_TCK')
        begin, end = (machine.Jiffies('cpu ' + ' '.join(str(value * ticks) for value in stat), spent)
                      for stat, spent in ((before, 0.0), (after, own)))
        end.at = begin.at + 10
        return machine.use_between(begin, end, 2)

    def test_split_the_time_into_others_and_stolen(self):
        #                    user nice system idle wait irq soft steal
        use = self.between((100, 0, 10, 500, 0, 0, 0, 1), (106, 1, 11, 510, 0, 0, 0, 3), own=3)
        self.assertEqual(use['others'], 0.5)
        self.assertEqual(use['stolen'], 0.1)

    def test_of_an_idle_machine_give_no_warning(self):
        use = self.between((100, 0, 10, 500, 0, 0, 0, 1), (100, 0, 10, 520, 0, 0, 0, 1))
        self.assertEqual(machine.warnings_of(use, 'before the start'), [])

    def test_of_a_busy_machine_give_warnings(self):
        use = self.between((100, 0, 10, 500, 0, 0, 0, 1), (115, 0, 10, 505, 0, 0, 0, 3))
        self.assertEqual(machine.warnings_of(use, 'before the start'), [
            'The machine was busy before the start: other programs used 150 % of a processor. The figures are those of a '
            'busy machine.',
            'The host took 10.0 % of the processors away before the start.'])


class Description(unittest.TestCase):

    def test_names_processor_and_kernel(self):
        description = machine.description()
        self.assertEqual(description['kernel'], os.uname().release)
        self.assertGreaterEqual(description['usable_processors'], 1)
        self.assertTrue(description['processor'])


class Build(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.tree = Path(folder.name)

    def test_of_a_tree_is_what_cmake_remembers(self):
        (self.tree / 'CMakeCache.txt').write_text(
            '# This is the CMakeCache file.\n//Flags=\nCMAKE_BUILD_TYPE:STRING=Release\n'
            'CMAKE_CXX_FLAGS_RELEASE:STRING=-O2 -DNDEBUG\n')
        self.assertEqual(machine.build_of(self.tree), 'Release, -O2 -DNDEBUG')
        with (self.tree / 'CMakeCache.txt').open('a') as cache:
            cache.write('CMAKE_UNITY_BUILD:BOOL=ON\n')
        self.assertEqual(machine.build_of(self.tree), 'Release, -O2 -DNDEBUG, several sources compiled as one')

    def test_of_something_else_is_unknown(self):
        self.assertIsNone(machine.build_of(self.tree))


class Settings(unittest.TestCase):

    def test_are_described_whether_or_not_they_are_permitted(self):
        with Tuning(real_time=False) as tuning:
            described = {setting.name: setting for setting in tuning.settings}
        self.assertEqual(described['real-time priority'].state, 'as found')
        self.assertIn('idle states', described)
        self.assertIn('frequency', described)
        for setting in described.values():
            self.assertIn(setting.state, ('set', 'as found', 'refused', 'absent'))
            self.assertTrue(setting.detail)


if __name__ == '__main__':
    unittest.main()
