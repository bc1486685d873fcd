# SPDX-License-Identifier: Apache-2.0
"""
Checks of the repository as a whole: every source names its licence, and the version is written in one place.

The version is that of `project(launch VERSION ...)` in CMakeLists.txt. The launcher, the newest release in CHANGELOG.md and
the packages of this project agree with it. Packages that stand in for a package of ROS 2 have the version of the release
whose interface they have.
"""

import os
import re
import subprocess
import unittest
from pathlib import Path

LAUNCH = os.environ['LAUNCH_PROGRAM']
SOURCE = Path(os.environ['SOURCE_DIRECTORY'])

# Files without a licence line, by folder and by suffix. The text of an interface file is part of its type's description.
# JSON has no comments. A package.xml names its licence in an element.
EXEMPT_FOLDERS = ('docs/', 'launch_examples/', 'tests/golden/', 'third_party/', '.vscode/')
EXEMPT_SUFFIXES = ('.md', '.json', '.xml', '.msg', '.srv', '.action', '.tsv')
EXEMPT_NAMES = ('LICENSE', '.gitignore')

VERSIONS_OF_ROS_2 = {
    'ament_cmake': '2.5.0',
    'ament_index_cpp': '1.8.0',
    'class_loader': '2.7.0',
    'pluginlib': '5.4.2',
    'rcl': '9.2.0',
    'rcl_action': '9.2.0',
    'rcl_lifecycle': '9.2.0',
    'rcl_yaml_param_parser': '9.2.0',
    'rclcpp': '28.1.0',
    'rclcpp_action': '28.1.0',
    'rclcpp_components': '28.1.0',
    'rclcpp_lifecycle': '28.1.0',
    'rcpputils': '2.11.0',
    'rcutils': '6.7.0',
    'rmw': '7.3.0',
    'tracetools': '8.10.1',
}


def tracked_files():
    """The files under version control, or None when the sources are not a checkout."""
    try:
        # The user who runs the tests may not be the owner of the checkout.
        listed = subprocess.run(['git', '-c', 'safe.directory=*', 'ls-files', '-z'], cwd=SOURCE, capture_output=True)
    except FileNotFoundError:
        return None
    if listed.returncode != 0:
        return None
    return [name for name in listed.stdout.decode().split('\0') if name and (SOURCE / name).is_file()]


class Licence(unittest.TestCase):

    def setUp(self):
        self.files = tracked_files()
        if self.files is None:
            self.skipTest('the sources are not a checkout of git')

    def test_every_source_names_it(self):
        sources = [name for name in self.files
                   if not name.startswith(EXEMPT_FOLDERS) and not name.endswith(EXEMPT_SUFFIXES)
                   and Path(name).name not in EXEMPT_NAMES]
        self.assertGreater(len(sources), 1000)
        for name in sources:
            with self.subTest(name):
                # The first line, or the second one below `#!`.
                head = (SOURCE / name).read_text(errors='replace').splitlines()[:2]
                self.assertTrue(any('SPDX-License-Identifier: Apache-2.0' in line for line in head),
                                f'{name} has no line "SPDX-License-Identifier: Apache-2.0" at its top')

    def test_every_package_names_it(self):
        for name in self.files:
            if Path(name).name == 'package.xml':
                with self.subTest(name):
                    self.assertRegex((SOURCE / name).read_text(), r'<license>Apache(-| License )2\.0</license>')


class Version(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.version = re.search(r'^project\(launch VERSION (\S+)', (SOURCE / 'CMakeLists.txt').read_text(), re.M)[1]

    def test_launcher(self):
        told = subprocess.run([LAUNCH, '--version'], capture_output=True, text=True, check=True).stdout
        self.assertEqual(told, f'launch {self.version}\n')

    def test_packages(self):
        packages = sorted(SOURCE.glob('instrumented_stack/**/package.xml')) + [SOURCE / 'launch_examples/package.xml']
        self.assertGreater(len(packages), 40)
        for path in packages:
            text = path.read_text()
            name = re.search(r'<name>(.*)</name>', text)[1]
            with self.subTest(name):
                self.assertEqual(re.search(r'<version>(.*)</version>', text)[1],
                                 VERSIONS_OF_ROS_2.get(name, self.version))

    def test_changelog(self):
        releases = re.findall(r'^## \[(\d[^\]]*)\]', (SOURCE / 'CHANGELOG.md').read_text(), re.M)
        self.assertEqual(releases[0], self.version)


if __name__ == '__main__':
    unittest.main()
