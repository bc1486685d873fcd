# SPDX-License-Identifier: Apache-2.0
"""
Python launch files of our own, each a pattern of real use, against what ROS 2's launch would start.

expected.json is a recording of the reference engine: launch 3.7.1 and launch_ros 0.28.0, with PathSubstitution as
later releases have it. LAUNCH_PROGRAM is the launcher.
"""

import json
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

import yaml

HERE = pathlib.Path(__file__).parent
LAUNCH = os.environ['LAUNCH_PROGRAM']
SANITIZERS = ('ASAN_OPTIONS', 'LSAN_OPTIONS')


def prefix_at(folder):
    """An install prefix with the package `demo` and the programs that the files ask for."""
    index = folder / 'share/ament_index/resource_index/packages'
    index.mkdir(parents=True)
    (folder / 'share/demo').symlink_to(HERE / 'demo')
    (folder / 'share/rclcpp_components').mkdir()
    for line in (HERE / 'demo/executables.tsv').read_text().splitlines():
        package, executable = line.split('\t')
        (index / package).touch()
        (folder / 'lib' / package).mkdir(parents=True, exist_ok=True)
        program = folder / 'lib' / package / executable
        program.write_text('#!/bin/sh\n')
        program.chmod(0o755)
    return folder


def same(expected, actual):
    """Equal, where $ANON stands for any word."""
    if isinstance(expected, str) and '$ANON' in expected and isinstance(actual, str):
        return re.fullmatch(r'[A-Za-z0-9_]+'.join(map(re.escape, expected.split('$ANON'))), actual, re.DOTALL)
    if isinstance(expected, list) and isinstance(actual, list):
        return len(expected) == len(actual) and all(map(same, expected, actual))
    return expected == actual and type(expected) is type(actual)


class PythonCorpus(unittest.TestCase):
    maxDiff = None

    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.temporary.cleanup)
        folder = pathlib.Path(cls.temporary.name).resolve()
        cls.home, cls.tmp = folder / 'home', folder / 'tmp'
        cls.home.mkdir()
        cls.tmp.mkdir()
        cls.prefix = prefix_at(folder / 'prefix')
        cls.environment = {'USER': 'user', 'LANG': 'C.UTF-8', 'HOME': str(cls.home), 'TMPDIR': str(cls.tmp),
                           'ROS_DISTRO': 'jazzy', 'AMENT_PREFIX_PATH': str(cls.prefix),
                           'PATH': f'{cls.prefix}/bin:/usr/bin:/bin',
                           **{name: os.environ[name] for name in SANITIZERS if name in os.environ}}

    def plan(self, record):
        """(outcome, plan, what is on standard error)"""
        words = [f'{name}:={value}' for name, value in record['args'].items()]
        done = subprocess.run([LAUNCH, '--dry-run=json', str(HERE / 'python' / record['file']), *words],
                              env=self.environment, cwd=self.home, capture_output=True, text=True, timeout=300,
                              stdin=subprocess.DEVNULL)
        self.assertIn(done.returncode, (0, 1), done.stderr)
        for path, name in ((HERE / 'python', '$CORPUS'), (self.prefix, '$PREFIX'), (self.home, '$HOME'),
                           (self.tmp, '$TMP')):
            done.stdout = done.stdout.replace(str(path), name)
        return 'error' if done.returncode else 'ok', json.loads(done.stdout or '{}'), done.stderr

    def parameters(self, word, process):
        """What a parameter file holds; None for any other word."""
        if found := re.fullmatch('@params:([0-9]+)', word):
            return process['params'][int(found[1])]
        path = pathlib.Path(word.replace('$TMP', str(self.tmp)).replace('$PREFIX', str(self.prefix)))
        text = path.read_text() if '\n' not in word and path.is_file() else word
        content = yaml.safe_load(text) if ':' in text else None
        return content if isinstance(content, dict) else None

    def differences(self, record):
        """Kinds of differences, each with a text."""
        outcome, plan, error = self.plan(record)
        if outcome != record['outcome']:
            return {'outcome': f'expected {record["outcome"]}, got {outcome}: {error}'}
        if outcome == 'error':
            return {}
        found = {}
        for field in ('logs', 'composable'):
            if not same(record[field], plan[field]):
                found[field] = f'expected {record[field]}, got {plan[field]}'
        names = [[process['name'] for process in each['processes']] for each in (record, plan)]
        if names[0] != names[1]:
            found['processes'] = f'expected {names[0]}, got {names[1]}'
            return found
        for expected, actual in zip(record['processes'], plan['processes']):
            for name in SANITIZERS:
                actual.get('env', {}).pop(name, None)
            for field, default in (('cwd', None), ('env', {}), ('shell', False)):
                if (expected.get(field) or default) != (actual.get(field) or default):
                    found[field] = f'{expected["name"]}: expected {expected.get(field)}, got {actual.get(field)}'
            pairs = list(zip(expected['argv'], actual['argv']))
            wrong = [(want, got) for want, got in pairs if not same(want, got) and (
                self.parameters(want, expected) is None or
                self.parameters(want, expected) != self.parameters(got, actual))]
            if wrong or len(expected['argv']) != len(actual['argv']):
                found['argv'] = f'{expected["name"]}: expected {expected["argv"]}, got {actual["argv"]}'
        return found

    def test_plans_agree_with_the_reference_but_for_deliberate_differences(self):
        rows = (HERE / 'deliberate_python_differences.tsv').read_text().splitlines()[1:]
        deliberate = {tuple(row.split('\t')[:2]) for row in rows}
        found = set()
        recorded = set()
        for line in (HERE / 'python/expected.json').read_text().splitlines():
            record = json.loads(line)
            recorded.add(record['file'])
            differences = self.differences(record)
            found.update((record['file'], kind) for kind in differences)
            for kind, text in differences.items():
                with self.subTest(file=record['file'], variant=record['variant'], kind=kind):
                    self.assertIn((record['file'], kind), deliberate, text)
        self.assertEqual(deliberate - found, set(), 'these agree: remove them from the deliberate differences')
        self.assertEqual(recorded, {path.name for path in (HERE / 'python').glob('*.launch.py')})


if __name__ == '__main__':
    unittest.main()
