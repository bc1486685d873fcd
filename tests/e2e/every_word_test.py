"""Every action, every item and every substitution stands in a pair of launch files, XML and YAML, that a test compares."""

import os
import re
import subprocess
import unittest
from pathlib import Path

LAUNCH = os.environ['LAUNCH_PROGRAM']
GOLDEN = Path(os.environ['SOURCE_DIRECTORY']) / 'tests/golden'


def texts(suffix):
    """Those that tests/unit/python/triplets_test.cpp compares by what they ask for, the others by what they say."""
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


if __name__ == '__main__':
    unittest.main()
