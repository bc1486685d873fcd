# SPDX-License-Identifier: Apache-2.0
"""The extension for Visual Studio Code: its tests run in node."""

import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

PATIENCE = 300  # seconds
OLDEST = 18  # that has a runner of tests


def version_of_node():
    node = shutil.which('node')
    if node is None:
        return None
    text = subprocess.run([node, '--version'], stdout=subprocess.PIPE, check=True, text=True).stdout
    return int(text.strip().removeprefix('v').split('.')[0])


class Extension(unittest.TestCase):

    def test_extension(self):
        version = version_of_node()
        if version is None or version < OLDEST:
            self.skipTest(f'because node {OLDEST} or later is not installed')
        directory = Path(tempfile.mkdtemp(prefix='vscode_extension_test-'))
        self.addCleanup(shutil.rmtree, directory)
        subprocess.run([os.environ['WRITE_EXAMPLE_TRACE'], directory / 'trace', '100'], check=True)
        run = subprocess.run(['node', '--test', Path(__file__).parent / 'extension.test.cjs'], text=True, timeout=PATIENCE,
                             env={**os.environ, 'EXAMPLE_TRACE': str(directory / 'trace')},
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        print(run.stdout)
        self.assertEqual(run.returncode, 0)


if __name__ == '__main__':
    unittest.main()
