# SPDX-License-Identifier: Apache-2.0
"""
Launch files with errors, each with all that is said about it: tests/golden/errors, FILE and FILE.expected.

docs/errors.md shows these messages and those of tests/golden/diagnostics and tests/golden/python. With
LAUNCH_UPDATE_GOLDEN=1 the expected texts and the page are written anew; read them before committing.
"""

import os
import re
import subprocess
import tempfile
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

LAUNCH = os.environ['LAUNCH_PROGRAM']
SOURCE = Path(os.environ['SOURCE_DIRECTORY'])
GOLDEN = SOURCE / 'tests/golden'
PAGE = SOURCE / 'docs/errors.md'
UPDATE = 'LAUNCH_UPDATE_GOLDEN' in os.environ

SECTIONS = [
    ('XML that is malformed', 'diagnostics', '.xml', 'Found while a file is read.'),
    ('YAML that is malformed', 'diagnostics', '.yaml', 'Found while a file is read.'),
    ('Launch files that say what nothing understands', 'errors/load', '',
     'Found when a file is loaded; all errors of a file are told at once, and nothing of it is visited.'),
    ('Launch files that ask for what cannot be', 'errors/visit', '',
     'Found when the actions are visited, before any process has started, or when a timer or an event handler visits '
     'further ones: then the system ends.'),
    ('Python launch files', 'python', '.py', 'Without a traceback; `--debug` adds it.'),
]

HEAD = """# Errors

What is said about launch files that cannot run: the place, the line with a caret below what is meant, the cause, and what to do about it; for a
file that others include, the chain of includes. The launcher's exit code is 1, and no process was started. Each message is that of a launch file in
`tests/golden/`, which a test compares with it; this page is made of them (`tests/e2e/golden_errors_test.py`).
"""


def launch_files(folder, suffix=''):
    return sorted(path for path in (GOLDEN / folder).iterdir()
                  if path.suffix != '.expected' and path.is_file() and path.name.endswith(suffix))


def title(path):
    name = path.name.split('.')[0].replace('_', ' ')
    return name[0].upper() + name[1:]


def page():
    parts = [HEAD]
    for heading, folder, suffix, when in SECTIONS:
        parts.append(f'\n## {heading}\n\n{when}\n')
        for path in launch_files(folder, suffix):
            message = Path(f'{path}.expected').read_text().rstrip('\n')
            parts.append(f'\n### {title(path)}\n\n```\n{message}\n```\n')
    return ''.join(parts)


class GoldenErrors(unittest.TestCase):
    maxDiff = None

    @classmethod
    def setUpClass(cls):
        cls.directory = tempfile.TemporaryDirectory()
        prefix = Path(cls.directory.name) / 'prefix'
        for folder in ('share/ament_index/resource_index/packages', 'share/golden_demo', 'lib/golden_demo'):
            (prefix / folder).mkdir(parents=True)
        (prefix / 'share/ament_index/resource_index/packages/golden_demo').touch()
        talker = prefix / 'lib/golden_demo/talker'
        talker.write_text('#!/bin/sh\n')
        talker.chmod(0o755)
        cls.prefix = str(prefix)

    @classmethod
    def tearDownClass(cls):
        cls.directory.cleanup()

    def run_launch(self, path):
        return subprocess.run(
            [LAUNCH, '--dry-run', str(path)], capture_output=True, text=True, timeout=50,
            env={'PATH': '/usr/bin:/bin', 'HOME': self.directory.name, 'AMENT_PREFIX_PATH': self.prefix,
                 'LANG': 'C.UTF-8', **{name: os.environ.get(name, '') for name in ('ASAN_OPTIONS', 'LSAN_OPTIONS')}})

    def test_every_message(self):
        files = [path for folder in ('errors/load', 'errors/visit') for path in launch_files(folder)]
        self.assertGreater(len(files), 80)
        with ThreadPoolExecutor(2) as pool:
            results = list(pool.map(self.run_launch, files))
        for path, result in zip(files, results):
            with self.subTest(path.name):
                self.assertEqual(result.returncode, 1, result.stderr)
                self.assertEqual(result.stdout, '')
                # Where the checkout and the prefixes are is not the file's business.
                text = result.stderr.replace(f'{path.parent}/', '').replace(f'{GOLDEN}/errors/', '')
                text = text.replace(self.prefix, 'PREFIX').replace(str(Path(LAUNCH).parent.parent), 'OWN_PREFIX')
                expected = Path(f'{path}.expected')
                if UPDATE:
                    expected.write_text(text)
                self.assertEqual(text, expected.read_text())
                self.assertRegex(text, r'^[^\n]+:\d+:\d+: error: [^\n]+\n +\d+ \| ')
                self.assertIn('^', text)
                # What to do about it, unless the cause names all that is right.
                self.assertRegex(text, r'= help: |expected |can be |Valid options|is not a valid package name|No such file|not found: |is not a file')

    def test_the_page_shows_them(self):
        made = page()
        self.assertIsNone(re.search(r'/(tmp|home|work|root)/', made))
        if UPDATE:
            PAGE.write_text(made)
        self.assertEqual(made, PAGE.read_text())


if __name__ == '__main__':
    unittest.main()
