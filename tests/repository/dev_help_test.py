# SPDX-License-Identifier: Apache-2.0
"""
`./dev COMMAND --help` tells about the command, and builds nothing.
"""

import os
import re
import subprocess
import unittest
from pathlib import Path

SOURCE = Path(os.environ['SOURCE_DIRECTORY'])


def dev(*words):
    return subprocess.run(['/bin/bash', SOURCE / 'dev', *words], capture_output=True, text=True, timeout=60)


class Help(unittest.TestCase):

    def test_every_command_has_its_own(self):
        commands = re.findall(r'^  ([a-z-]+) ', dev('help').stdout, re.MULTILINE)
        self.assertIn('bench', commands)
        for command in set(commands) - {'launch'}:  # its words are the launcher's, which is built for them
            with self.subTest(command):
                result = dev(command, '--help')
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertRegex(result.stdout, rf'^(Usage|usage): (\./)?dev {command}')
                self.assertEqual(result.stderr, '')

    def test_it_is_the_part_of_the_whole_help(self):
        self.assertEqual(dev('clean', '-h').stdout, 'Usage: ./dev clean            remove build and install trees\n')

    def test_a_command_that_does_not_exist(self):
        result = dev('tset', '--help')
        self.assertEqual(result.returncode, 2)
        self.assertEqual(result.stderr.splitlines()[0], "dev: error: unknown command 'tset'")


if __name__ == '__main__':
    unittest.main()
