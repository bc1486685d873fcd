# SPDX-License-Identifier: Apache-2.0
"""
Launch files with errors, each with the whole text of its message: tests/golden/errors, FILE and FILE.expected.

docs/errors.md is an index of these files and of those in tests/golden/diagnostics and tests/golden/python. With
LAUNCH_UPDATE_GOLDEN=1 the expected texts and the samples of the page are written anew; read them before committing.
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

FOLDERS = ('diagnostics', 'errors/load', 'errors/visit', 'python')

# A sample in the page: the name of the launch file in a line of its own, then the message.
SAMPLE = re.compile(r'^`(?P<name>[\w.]+)`:\n\n```\n(?P<message>.*?\n)```$', re.M | re.S)


def launch_files(folder):
    return sorted(path for path in (GOLDEN / folder).iterdir() if path.suffix != '.expected' and path.is_file())


def sections(page):
    """The folder of each section with its text."""
    parts = re.split(r'^Launch files in `tests/golden/([\w/]+)`', page, flags=re.M)
    return list(zip(parts[1::2], parts[2::2]))


def with_samples(page):
    """The page with the expected text of each sample."""
    made = re.split(r'(^Launch files in `tests/golden/([\w/]+)`)', page, flags=re.M)
    for place in range(2, len(made), 3):
        folder = GOLDEN / made[place]
        made[place + 1] = SAMPLE.sub(
            lambda match: f'`{match["name"]}`:\n\n```\n{(folder / (match["name"] + ".expected")).read_text()}```',
            made[place + 1])
        made[place] = ''
    return ''.join(made)


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
                # The places of the checkout and of the prefixes must not be in the expected text.
                text = result.stderr.replace(f'{path.parent}/', '').replace(f'{GOLDEN}/errors/', '')
                text = text.replace(self.prefix, 'PREFIX').replace(str(Path(LAUNCH).parent.parent), 'OWN_PREFIX')
                expected = Path(f'{path}.expected')
                if UPDATE:
                    expected.write_text(text)
                self.assertEqual(text, expected.read_text())
                self.assertRegex(text, r'^[^\n]+:\d+:\d+: error: [^\n]+\n +\d+ \| ')
                self.assertIn('^', text)
                # There is help, unless the cause already names everything that is right.
                self.assertRegex(text, r'= help: |expected |can be |Valid options|is not a valid package name|No such file|not found: |is not a file')

    def test_the_page_names_each_file_once(self):
        found = dict(sections(PAGE.read_text()))
        self.assertEqual(sorted(found), sorted(FOLDERS))
        for folder, text in found.items():
            with self.subTest(folder):
                prose = SAMPLE.sub(lambda match: f'`{match["name"]}`', text)
                named = re.findall(r'`(\w+\.launch\.(?:xml|yaml|py))`', prose)
                self.assertEqual(sorted(named), [path.name for path in launch_files(folder)])

    def test_each_kind_has_one_sample(self):
        for folder, text in sections(PAGE.read_text()):
            for kind in re.split(r'^### ', text.partition('\n## ')[0], flags=re.M)[1:]:
                with self.subTest(f'{folder}: {kind.splitlines()[0]}'):
                    self.assertEqual(len(SAMPLE.findall(kind)), 1)

    def test_the_samples_are_the_messages(self):
        page = PAGE.read_text()
        made = with_samples(page)
        self.assertIsNone(re.search(r'/(tmp|home|work|root)/', made))
        if UPDATE:
            PAGE.write_text(made)
            page = made
        self.assertEqual(made, page)


if __name__ == '__main__':
    unittest.main()
