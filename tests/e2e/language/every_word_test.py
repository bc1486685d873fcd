# SPDX-License-Identifier: Apache-2.0
"""
Every word of the launch language is tested.

Every action, item and substitution is in a pair of launch files, XML and YAML, that a test compares. Every extension is
refused by `launch check --strict-ros2` and has its place in the documentation.
"""

import json
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

LAUNCH = os.environ['LAUNCH_PROGRAM']
GOLDEN = Path(os.environ['SOURCE_DIRECTORY']) / 'tests/golden'


def texts(suffix):
    """The launch files of triplets, which are compared by their requests, and of twins, compared by their entities."""
    return '\n'.join(path.read_text() for folder in ('triplets', 'twins')
                     for path in sorted((GOLDEN / folder).glob(f'*.launch.{suffix}')))


class EveryWord(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.reference = subprocess.run([LAUNCH, 'reference'], capture_output=True, text=True, check=True).stdout
        cls.xml = texts('xml')
        cls.yaml = texts('yaml')

    def test_actions_and_items(self):
        tags = re.findall(r'^### `([\w-]+)`', self.reference, re.M)
        tags += re.findall(r'^Item (?:of `\w+`, )?`(\w+)`', self.reference, re.M)
        self.assertGreater(len(tags), 50)
        for tag in sorted(set(tags)):
            with self.subTest(tag):
                self.assertRegex(self.xml, rf'<{tag}[\s/>]')
                self.assertRegex(self.yaml, rf'(^|[\s{{]){tag}:')

    def test_substitutions(self):
        names = re.findall(r'^\| `\$\(([\w-]+)', self.reference, re.M)
        self.assertGreater(len(names), 20)
        for name in names:
            with self.subTest(name):
                self.assertRegex(self.xml, rf'\$\({name}[\s)]')
                self.assertRegex(self.yaml, rf'\$\({name}[\s)]')


def extensions(reference):
    """(action, names of the items down to the element, attribute) of all that the reference marks; '' for none."""
    found = []
    action, path = '', ()
    for line in reference.partition('## Substitutions')[0].splitlines():
        if match := re.match(r'### `([\w-]+)`( \\\*)?', line):
            action, path = match[1], ()
        elif match := re.match(r'Item (?:of `(\w+)`, )?`(\w+)`( \\\*)?', line):
            path = (match[1], match[2]) if match[1] else (match[2],)
        elif match := re.match(r'\| `([\w-]+)`( \\\*)? \|', line):
            if match[2]:
                found.append((action, path, match[1]))
            continue
        else:
            continue
        if match[match.lastindex or 0] and match[0].endswith('\\*'):
            found.append((action, path, ''))
    return found


class Extensions(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.found = extensions(subprocess.run([LAUNCH, 'reference'], capture_output=True, text=True, check=True).stdout)

    def test_strict_check_refuses_each(self):
        self.assertGreater(len(self.found), 100)
        text = '<launch>\n'
        expected = []
        for action, path, attribute in self.found:
            given = f' {attribute}="1"' if attribute else ''
            inner = ''
            for depth, tag in enumerate(reversed(path)):
                inner = f'<{tag}{given if depth == 0 else ""}>{inner}</{tag}>'
            text += f'<{action}{"" if path else given}>{inner}</{action}>\n'
            element = path[-1] if path else action
            what = f"attribute '{attribute}' of <{element}>" if attribute else f'<{element}>'
            expected.append((text.count('\n'), f'{what} is not known to ros2 launch'))
        with tempfile.TemporaryDirectory() as directory:
            path = Path(directory) / 'all.launch.xml'
            path.write_text(text + '</launch>\n')
            result = subprocess.run([LAUNCH, 'check', '--strict-ros2', '--format', 'json', str(path)],
                                    capture_output=True, text=True)
        told = {(each['line'], each['message']) for each in json.loads(result.stdout)}
        for line, message in expected:
            with self.subTest(message):
                self.assertTrue((line, message) in told)

    def test_each_is_documented(self):
        docs = Path(os.environ['SOURCE_DIRECTORY']) / 'docs'
        pages = (docs / 'extensions.md').read_text() + (docs / 'trace_control.md').read_text()
        for name in sorted({attribute or (path or (action,))[-1] for action, path, attribute in self.found}):
            with self.subTest(name):
                self.assertIn(name, pages)


if __name__ == '__main__':
    unittest.main()
