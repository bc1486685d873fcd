# SPDX-License-Identifier: Apache-2.0
"""
The whole text that `launch check` prints for launch files: tests/golden/check, FILE and FILE.expected. What is not in
the text is no finding, so the files hold right things beside the wrong ones.

With LAUNCH_UPDATE_GOLDEN=1 the expected texts are written anew; read them before committing.
"""

import json
import os
import re
import subprocess
import tempfile
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

LAUNCH = os.environ['LAUNCH_PROGRAM']
FOLDER = Path(os.environ['SOURCE_DIRECTORY']) / 'tests/golden/check'
UPDATE = 'LAUNCH_UPDATE_GOLDEN' in os.environ

PLUGINS = 'parts::Talker;lib/libparts.so\nparts::Listener;lib/libparts.so\nparts::Lost;lib/liblost.so\n'


class CheckFindings(unittest.TestCase):
    maxDiff = None

    @classmethod
    def setUpClass(cls):
        cls.directory = tempfile.TemporaryDirectory()
        prefix = Path(cls.directory.name) / 'prefix'
        index = prefix / 'share/ament_index/resource_index'
        for folder in ('packages', 'rclcpp_components'):
            (index / folder).mkdir(parents=True)
        for package in ('golden_demo', 'golden_parts'):
            (index / 'packages' / package).touch()
            (prefix / 'share' / package).mkdir()
        (index / 'rclcpp_components/golden_parts').write_text(PLUGINS)
        (prefix / 'lib/golden_demo').mkdir(parents=True)
        (prefix / 'lib/libparts.so').touch()
        talker = prefix / 'lib/golden_demo/talker'
        talker.write_text('#!/bin/sh\n')
        talker.chmod(0o755)
        cls.prefix = str(prefix)

    @classmethod
    def tearDownClass(cls):
        cls.directory.cleanup()

    def check(self, *words):
        return subprocess.run(
            [LAUNCH, 'check', *words], capture_output=True, text=True, timeout=50, cwd=self.directory.name,
            env={'PATH': '/usr/bin:/bin', 'HOME': self.directory.name, 'AMENT_PREFIX_PATH': self.prefix,
                 'LANG': 'C.UTF-8', **{name: os.environ.get(name, '') for name in ('ASAN_OPTIONS', 'LSAN_OPTIONS')}})

    def test_every_finding(self):
        files = sorted(path for path in FOLDER.iterdir() if path.suffix != '.expected' and path.is_file())
        self.assertGreater(len(files), 10)
        with ThreadPoolExecutor(2) as pool:
            results = list(pool.map(lambda path: self.check(str(path)), files))
        for path, result in zip(files, results):
            with self.subTest(path.name):
                self.assertEqual(result.stderr, '')
                # Places of the checkout and the number of this machine's CPUs must not be in the expected text.
                text = result.stdout.replace(f'{path.parent}/', '').replace(self.prefix, 'PREFIX')
                text = text.replace(str(Path(LAUNCH).parent.parent), 'OWN_PREFIX')
                text = re.sub(r'its CPUs are 0 to \d+', 'its CPUs are 0 to N', text)
                expected = Path(f'{path}.expected')
                if UPDATE:
                    expected.write_text(text)
                self.assertEqual(text, expected.read_text())
                self.assertEqual(result.returncode, 0 if ': 0 errors' in text else 1)

    def test_json_and_sarif_have_the_findings_of_all_files(self):
        files = [str(FOLDER / name) for name in ('missing_include.launch.xml', 'remaps.launch.xml')]
        found = json.loads(self.check('--format', 'json', *files, 'nowhere.launch.xml').stdout)
        sarif = json.loads(self.check('--format', 'sarif', *files, 'nowhere.launch.xml').stdout)
        results = sarif['runs'][0]['results']
        self.assertEqual([item['id'] for item in found], [item['ruleId'] for item in results])
        self.assertEqual({item['id'] for item in found}, {'LF0001', 'LF0101', 'LF0302', 'LF0402', 'LF0403'})
        self.assertEqual(sorted({item['id'] for item in found}),
                         [rule['id'] for rule in sarif['runs'][0]['tool']['driver']['rules']])
        self.assertEqual({item['severity'] for item in found}, {item['level'] for item in results})

    def test_a_directory_stands_for_all_launch_files_below_it(self):
        below = Path(self.directory.name) / 'below/launch'
        below.mkdir(parents=True)
        for name in ('b_launch.py', 'a.launch.xml', 'c.launch.yaml', 'no.xml'):
            (below / name).write_text('<')
        text = self.check('below').stdout
        self.assertEqual([Path(line.partition(':')[0]).name for line in text.splitlines() if 'error: ' in line],
                         ['a.launch.xml', 'b_launch.py', 'c.launch.yaml'])
        self.assertTrue(text.endswith('\n3 files: 3 errors, 0 warnings\n'), text)
        (below.parent / 'empty').mkdir()
        self.assertEqual(self.check('below/empty', str(FOLDER / 'remaps.launch.xml')).stdout.partition('\n')[0],
                         "error: there are no launch files in 'below/empty' [LF0001]")
        # A package and a file of it, in a directory that holds a directory of this name.
        (Path(self.directory.name) / 'golden_parts').mkdir()
        (Path(self.prefix) / 'share/golden_parts/x.launch.xml').write_text('<launch/>')
        self.assertEqual(self.check('golden_parts', 'x.launch.xml').stdout, '1 file: 0 errors, 0 warnings\n')


if __name__ == '__main__':
    unittest.main()
