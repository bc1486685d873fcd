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
EXEMPT_FOLDERS = ('docs/', 'debian/source/', '.github/', 'launch_examples/', 'tests/golden/', 'third_party/', '.vscode/')
EXEMPT_SUFFIXES = ('.md', '.json', '.xml', '.msg', '.srv', '.action', '.tsv', '.xz')
EXEMPT_NAMES = ('LICENSE', '.gitignore', 'changelog', 'copyright')

VERSIONS_OF_ROS_2 = {
    'ament_cmake': '2.5.0',
    'ament_index_cpp': '1.8.0',
    'class_loader': '2.7.0',
    'pluginlib': '5.4.2',
    'rcl': '9.2.0',
    'rcl_action': '9.2.0',
    'rcl_lifecycle': '9.2.0',
    'rcl_logging_interface': '3.1.0',
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


class OneForm(unittest.TestCase):
    """What the formatter makes, checked where it is not installed; and what it does not look at."""

    BODY_WITHOUT_BRACES = re.compile(r'^\s*((\} )?else if|if|for|while) (constexpr )?\(.*\) [^{}]*;$|^\s*(\} )?else (?!if )[^{]*;$')

    @classmethod
    def setUpClass(cls):
        cls.texts = {name: (SOURCE / name).read_text(encoding='utf-8') for name in tracked_files() or []
                     if name.endswith(('.cpp', '.hpp', '.c', '.h')) and not name.startswith('third_party/')}

    def setUp(self):
        if not self.texts:
            self.skipTest('the sources are not a checkout of git')

    def lines_like(self, expression):
        return [f'{name}:{number}: {line.strip()}' for name, text in self.texts.items()
                for number, line in enumerate(text.splitlines(), 1) if expression.search(line)]

    def test_the_expressions_find_what_they_forbid(self):
        for line in ('  if (a) return;', '} else if (a) b();', '  else return 1;', '  for (int i : all) use(i);', '  while (more()) step();'):
            self.assertRegex(line, self.BODY_WITHOUT_BRACES)
        for line in ('  if (a) {', '  } while (more());', '  } else {', '  for (;;) {', '  // if (a) b();'):
            self.assertNotRegex(line, self.BODY_WITHOUT_BRACES)

    def test_every_body_has_braces(self):
        # A line that opens more parentheses than it closes is the beginning of a condition.
        self.assertEqual([line for line in self.lines_like(self.BODY_WITHOUT_BRACES) if line.count('(') == line.count(')')], [])

    def test_comments_have_two_slashes(self):
        self.assertEqual(self.lines_like(re.compile(r'^\s*///')), [])

    def test_every_header_says_pragma_once(self):
        # LTTng reads the headers of tracepoints several times.
        self.assertEqual([name for name, text in self.texts.items() if name.endswith(('.hpp', '.h'))
                          and '\n#pragma once\n' not in text and 'HEADER_MULTI_READ' not in text], [])


    def test_what_joins_texts_includes_the_header_that_newer_versions_of_fmt_have_it_in(self):
        self.assertEqual([name for name, text in self.texts.items() if 'fmt::join(' in text and '#include <fmt/ranges.h>' not in text], [])


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

    def test_packages_of_debian(self):
        newest = re.match(r'launch \((.*)\)', (SOURCE / 'debian/changelog').read_text())[1]
        self.assertEqual(newest, self.version)

    def test_changelog(self):
        releases = re.findall(r'^## \[(\d[^\]]*)\]', (SOURCE / 'CHANGELOG.md').read_text(), re.M)
        self.assertEqual(releases[0], self.version)


if __name__ == '__main__':
    unittest.main()
