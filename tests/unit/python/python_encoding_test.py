# SPDX-License-Identifier: Apache-2.0
"""
Python launch files in other encodings than plain UTF-8. LAUNCH_PROGRAM is the launcher.
"""

import os
import pathlib
import subprocess
import tempfile
import unittest

LAUNCH = os.environ['LAUNCH_PROGRAM']
SOURCE = '''from launch import LaunchDescription
from launch.actions import ExecuteProcess
def generate_launch_description():
    return LaunchDescription([ExecuteProcess(cmd=['echo', 'é'])])
'''


class PythonEncoding(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.file = pathlib.Path(directory.name) / 'a.launch.py'

    def dry_run(self):
        return subprocess.run([LAUNCH, '--dry-run', str(self.file)], capture_output=True, text=True, check=False,
                              env={**os.environ, 'ROS_LOG_DIR': str(self.file.parent / 'log')})

    def test_a_byte_order_mark_is_passed_over(self):
        self.file.write_bytes(b'\xef\xbb\xbf' + SOURCE.encode())
        self.assertIn("\n  echo 'é'\n", self.dry_run().stdout)

    def test_a_coding_line_is_followed(self):
        self.file.write_bytes(b'# -*- coding: latin-1 -*-\n' + SOURCE.encode('latin-1'))
        self.assertIn("\n  echo 'é'\n", self.dry_run().stdout)

    def test_bytes_that_are_no_text_are_an_error(self):
        self.file.write_bytes(SOURCE.encode('latin-1'))
        result = self.dry_run()
        self.assertEqual(result.returncode, 1)
        # Python says the column; the text begins at 59.
        self.assertRegex(result.stderr, r'a\.launch\.py:4:(59|62): error: SyntaxError: ')


if __name__ == '__main__':
    unittest.main()
