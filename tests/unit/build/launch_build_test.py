# SPDX-License-Identifier: Apache-2.0
"""What `launch build` reads, in which order it builds, and what it shows of a failed build."""

import contextlib
import io
import os
import re
import tempfile
import unittest
import unittest.mock
from pathlib import Path

from launch_build.__main__ import main
from launch_build.log_errors import short_errors
from launch_build.package_xml import PackageError, read_package
from launch_build.prefixes import build_environment
from launch_build.test_results import TestCounts, read_counts
from launch_build.workspace import built_before, choose, find_packages, in_order


class InFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)
        self.folder = Path(folder.name)

    def package(self, name, *elements, folder=''):
        path = self.folder / (folder or f'src/{name}')
        path.mkdir(parents=True)
        lines = [f'<name>{name}</name>', *elements]
        (path / 'package.xml').write_text('<package format="3">\n  ' + '\n  '.join(lines) + '\n</package>\n')
        return path

    def run_command(self, *words):
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            try:
                code = main(list(words))
            except SystemExit as end:
                code = end.code
        return code, out.getvalue(), err.getvalue()


class PackageXml(InFolder):
    def test_dependencies_conditions_and_build_type(self):
        read = read_package(self.package(
            'arm', '<!-- <depend>left_out</depend> -->', '<buildtool_depend>ament_cmake</buildtool_depend>',
            '<depend condition="$ROS_VERSION == 2">rclcpp</depend>', '<depend condition="$ROS_VERSION == 1">roscpp</depend>',
            '<exec_depend condition="$ROS_DISTRO == foxy or ($ROS_DISTRO != iron and 1 == 1)">talker</exec_depend>',
            '<test_depend>ament_lint_auto</test_depend>', '<member_of_group>arms</member_of_group>',
            '<export><build_type>ament_python</build_type></export>'), {'ROS_DISTRO': 'jazzy'})
        self.assertEqual((read.name, read.build_type), ('arm', 'ament_python'))
        self.assertEqual(read.depends, ['rclcpp', 'ament_cmake', 'talker'])
        self.assertEqual((read.test_depends, read.groups), (['ament_lint_auto'], ['arms']))

    def test_errors_have_their_line(self):
        self.package('broken', '<depend>rclcpp</dependent>')
        with self.assertRaises(PackageError) as raised:
            read_package(Path('src/broken'), {})
        self.assertEqual(str(raised.exception),
                         'src/broken/package.xml:3: error: mismatched tag\n  <depend>rclcpp</dependent>')
        self.package('doubtful', '<depend condition="$A ==">rclcpp</depend>')
        with self.assertRaises(PackageError) as raised:
            read_package(Path('src/doubtful'), {})
        self.assertEqual(str(raised.exception), "src/doubtful/package.xml:3: error: '$A ==' is no condition\n"
                                                '  <depend condition="$A ==">rclcpp</depend>')


class Workspace(InFolder):
    def setUp(self):
        super().setUp()
        self.package('msgs', '<member_of_group>messages</member_of_group>')
        self.package('arm', '<depend>msgs</depend>', '<test_depend>arm_tests</test_depend>')
        self.package('arm_tests', '<depend>arm</depend>')
        self.package('bag', '<group_depend>messages</group_depend>', '<test_depend>arm</test_depend>')
        self.package('old', folder='src/ignored/old')
        (self.folder / 'src/ignored/COLCON_IGNORE').touch()
        self.packages = find_packages([self.folder / 'src'], {})

    def test_packages_come_after_those_that_they_need(self):
        self.assertEqual([package.name for package in in_order(self.packages)], ['msgs', 'arm', 'arm_tests', 'bag'])
        self.assertEqual(built_before(self.packages), {'msgs': set(), 'arm': {'msgs'}, 'arm_tests': {'arm'}, 'bag': {'msgs', 'arm'}})

    def test_named_packages_bring_what_they_need(self):
        self.assertEqual(sorted(choose(['arm'], self.packages, only=False)), ['arm', 'msgs'])
        self.assertEqual(sorted(choose(['arm'], self.packages, only=True)), ['arm'])

    def test_a_circle_is_named(self):
        self.package('a', '<depend>b</depend>')
        self.package('b', '<depend>a</depend>')
        with self.assertRaises(PackageError) as raised:
            in_order(find_packages([self.folder / 'src'], {}))
        self.assertEqual(str(raised.exception), 'error: these packages need one another: a → b → a')

    def test_two_packages_of_one_name(self):
        first, second = self.folder / 'src/msgs', self.package('msgs', folder='src/copies/msgs')
        with self.assertRaises(PackageError) as raised:
            find_packages([self.folder / 'src'], {})
        self.assertEqual(str(raised.exception), f"error: there are two packages 'msgs':\n  {second}\n  {first}")


class CommandLine(InFolder):
    def test_list(self):
        self.package('msgs')
        self.package('arm', '<depend>msgs</depend>')
        self.assertEqual(self.run_command('--list'), (0, 'msgs src/msgs\narm src/arm\n', ''))

    def test_wrong_words(self):
        usage = "      = help: see 'launch build --help'\n"
        self.package('msgs')
        self.assertEqual(self.run_command('--lst'), (2, '', f"launch build: error: unknown option '--lst'\n      = help: did you mean '--list'?\n{usage}"))
        self.assertEqual(self.run_command('-j', '0'), (2, '', f"launch build: error: --jobs must be a number above 0, and not '0'\n{usage}"))
        self.assertEqual(self.run_command('-C', 'nowhere'), (2, '', f"launch build: error: there is no folder 'nowhere'\n{usage}"))
        self.assertEqual(self.run_command('mgs'), (
            1, '', "launch build: error: there is no package 'mgs' in the workspace\n      = help: did you mean 'msgs'?\n"))

    def test_no_packages(self):
        self.assertEqual(self.run_command(), (1, '', f"launch build: error: there is no package.xml below '{self.folder.resolve()}'\n"))

    def test_packages_of_ros_1(self):
        self.package('old', '<buildtool_depend>catkin</buildtool_depend>')
        self.assertEqual(self.run_command(), (
            1, '', "launch build: error: package 'old' has the build type 'catkin'; there are ament_cmake, ament_python, cmake\n"
                   f'  {self.folder.resolve()}/src/old\n'))


class Tests(InFolder):
    def build(self, tests):
        path = self.package('arm', '<export><build_type>cmake</build_type></export>')
        (path / 'CMakeLists.txt').write_text(f'cmake_minimum_required(VERSION 3.16)\nproject(arm NONE)\nenable_testing()\n{tests}')
        with unittest.mock.patch('launch_build.__main__.write_setup_files'):  # they are in an installation only
            code, out, _ = self.run_command('--test')
        return code, re.sub(r' [0-9]+[.][0-9] s\b', ' T s', out)

    def test_are_counted(self):
        self.assertEqual(self.build('add_test(a true)\nadd_test(b true)\n'
                                    'add_test(c sh -c "exit 9")\nset_tests_properties(c PROPERTIES SKIP_RETURN_CODE 9)\n'),
                         (0, '[1/1] arm T s, 2 tests passed, 1 skipped\n1 package built in T s, 2 tests passed, 1 skipped\n'))

    def test_that_fail_are_counted(self):
        code, out = self.build('add_test(a true)\nadd_test(b false)\n')
        self.assertEqual(code, 1)
        self.assertEqual(out.splitlines()[0], '[1/1] arm: 1 of 2 tests failed')
        self.assertEqual(out.splitlines()[-1], '1 package built in T s, 1 of 2 tests failed, failed: arm')

    def test_none(self):
        self.assertEqual(self.build(''), (0, '[1/1] arm T s, no tests\n1 package built in T s, no tests\n'))

    def test_results_of_pytest(self):
        file = self.folder / 'pytest.xml'
        file.write_text('<testsuites><testsuite name="pytest" errors="1" failures="1" skipped="1" tests="5"/></testsuites>')
        self.assertEqual(str(read_counts(file)), '2 of 4 tests failed, 1 skipped')
        file.write_text('<testsuite name="(empty)" tests="3" failures="0" disabled="1" skipped="1"/>')
        self.assertEqual(str(read_counts(file)), '1 test passed, 1 skipped')

    def test_results_that_are_not_whole(self):
        file = self.folder / 'ctest.xml'
        file.write_text('<testsuite tests="5"')
        self.assertEqual(read_counts(file), TestCounts())


class Environment(InFolder):
    def test_prefixes_come_first_and_once(self):
        (self.folder / 'one/bin').mkdir(parents=True)
        result = build_environment({'AMENT_PREFIX_PATH': '/opt/ros:/other', 'PATH': '/bin'}, [self.folder / 'one', Path('/opt/ros')])
        self.assertEqual(result['AMENT_PREFIX_PATH'], f'{self.folder}/one:/opt/ros:/other')
        self.assertEqual(result['PATH'], f'{self.folder}/one/bin:/bin')
        self.assertNotIn('PYTHONPATH', result)


class ShortErrors(unittest.TestCase):
    def test_errors_of_compilers_and_cmake(self):
        self.assertEqual(short_errors('[1/2] Building\nFAILED: a.o\n/usr/bin/c++ -c a.cpp\na.cpp: In function f:\n'
                                      "a.cpp:3:5: error: 'x' was not declared\n    3 |   x;\n      |   ^\nninja: build stopped\n"),
                         ["a.cpp:3:5: error: 'x' was not declared", '    3 |   x;', '      |   ^'])
        self.assertEqual(short_errors('-- Looking\nCMake Error at CMakeLists.txt:3 (find_package):\n  no such package\n\n\n-- Configuring\n'),
                         ['CMake Error at CMakeLists.txt:3 (find_package):', '  no such package'])

    def test_the_end_of_an_output_without_errors(self):
        self.assertEqual(short_errors('\n'.join(str(line) for line in range(20))), [str(line) for line in range(12, 20)])


if __name__ == '__main__':
    unittest.main()
