# SPDX-License-Identifier: Apache-2.0
"""What `launch build` reads, in which order it builds, and what it shows of a failed build."""

import asyncio
import contextlib
import errno
import importlib.util
import io
import json
import os
import re
import sys
import tempfile
import unittest
import unittest.mock
from pathlib import Path

from launch_build.__main__ import main
from launch_build.debian_packages import KEYS, debian_packages, missing_packages
from launch_build.estimate import FILE, Estimate, in_words
from launch_build.log_errors import short_errors
from launch_build.package_xml import PackageError, read_package
from launch_build.prefixes import build_environment
from launch_build.test_results import TestCounts, read_counts
from launch_build.workspace import built_before, choose, find_packages, in_order, used


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

    def test_a_package_finds_what_its_tests_need_unless_it_needs_the_package(self):
        self.assertEqual(used(self.packages['bag'], self.packages), {'msgs', 'arm'})
        self.assertEqual(used(self.packages['arm'], self.packages), {'msgs'})
        self.package('tested', '<test_depend>bag</test_depend>')
        self.package('robot', '<depend>tested</depend>')
        packages = find_packages([self.folder / 'src'], {})
        self.assertEqual(used(packages['robot'], packages), {'tested', 'bag', 'arm', 'msgs'})

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

    def test_packages_as_colcon_names_them(self):
        for name, *needed in (('msgs',), ('arm', 'msgs'), ('base', 'msgs'), ('robot', 'arm', 'base')):
            self.package(name, *(f'<depend>{other}</depend>' for other in needed))

        def listed(*words):
            code, out, err = self.run_command('--list', *words)
            self.assertEqual((code, err), (0, ''))
            return [line.split()[0] for line in out.splitlines()]

        self.assertEqual(listed('--packages-up-to', 'arm', 'base', '--continue-on-error'), ['msgs', 'arm', 'base'])
        self.assertEqual(listed('--packages-select', 'arm', 'robot'), ['arm', 'robot'])
        self.assertEqual(listed('--packages-skip', 'arm', 'msgs'), ['base', 'robot'])
        self.assertEqual(listed('--packages-up-to', 'arm', '--packages-select', 'robot', '--packages-skip', 'msgs'), ['arm', 'robot'])
        self.assertEqual(listed('--cmake-args', '-DA=1', '-G', 'Ninja', '--', 'arm'), ['msgs', 'arm'])
        self.assertEqual(listed('--packages-skip', 'arm', '--', 'robot'), ['msgs', 'base', 'robot'])
        self.assertEqual(self.run_command('--packages-skip', 'amr'), (
            1, '', "launch build: error: there is no package 'amr' in the workspace\n      = help: did you mean 'arm'?\n"))
        self.assertEqual(self.run_command('--packages-up-to', '--list'), (
            2, '', "launch build: error: --packages-up-to needs the name of a package\n      = help: see 'launch build --help'\n"))

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

    def test_find_the_package_that_has_just_been_installed(self):
        python = f'lib/python{sys.version_info.major}.{sys.version_info.minor}/site-packages'
        code, out = self.build(f'install(CODE "file(WRITE ${{CMAKE_INSTALL_PREFIX}}/{python}/arm_of_test.py [[]])")\n'
                               f'add_test(imports {sys.executable} -B -c "import arm_of_test")\n')
        self.assertEqual((code, out), (0, '[1/1] arm T s, 1 test passed\n1 package built in T s, 1 test passed\n'))

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


class Jobs(InFolder):
    """Two packages of plain CMake, which build nothing."""

    def setUp(self):
        super().setUp()
        for name in ('arm', 'base'):
            path = self.package(name, '<export><build_type>cmake</build_type></export>')
            (path / 'CMakeLists.txt').write_text(f'cmake_minimum_required(VERSION 3.16)\nproject({name} NONE)\n')
        patch = unittest.mock.patch('launch_build.__main__.write_setup_files')  # they are in an installation only
        patch.start()
        self.addCleanup(patch.stop)

    def build_with(self, refused, *words):
        """Builds where the system refuses to start processes, by the number of the attempt and how many run."""
        start, attempts, running = asyncio.create_subprocess_exec, [], []

        async def create(*command, **keywords):
            attempts.append(command)
            alive = [process for process in running if process.returncode is None]
            if refused(len(attempts), len(alive)):
                raise BlockingIOError(errno.EAGAIN, os.strerror(errno.EAGAIN))
            running.append(await start(*command, **keywords))
            return running[-1]

        with unittest.mock.patch('asyncio.create_subprocess_exec', create):
            return self.run_command(*words)

    def test_wait_where_there_are_no_more_processes(self):
        code, out, err = self.build_with(lambda attempt, alive: alive > 0, '-j', '2')
        self.assertEqual((code, err), (0, ''), out)
        self.assertRegex(out, r'\n2 packages built in [0-9.]+ s\n$')

    def test_say_that_a_process_cannot_be_started(self):
        code, out, err = self.build_with(lambda attempt, alive: True, '-j', '1', 'arm')
        self.assertEqual((code, err), (1, ''))
        self.assertEqual(re.sub(r'[0-9.]+ s,', 'T s,', out),
                         '[1/1] arm: CMake could not configure it\n'
                         '    cmake: error: cannot be started: Resource temporarily unavailable\n'
                         '    all of it: build/arm/launch_build_configure.log\n'
                         '0 packages built in T s, failed: arm\n')

    @unittest.skipUnless(importlib.util.find_spec('setuptools'), 'because python3-setuptools is not installed')
    def test_install_packages_of_python_where_they_are_found(self):
        for name, settings in (('talk', ''), ('show', '[install]\ninstall_scripts=$base/lib/show\n')):
            path = self.package(name, '<export><build_type>ament_python</build_type></export>')
            (path / name).mkdir()
            (path / name / '__init__.py').write_text('def main():\n    pass\n')
            (path / 'setup.cfg').write_text(settings)
            (path / 'setup.py').write_text(
                f"from setuptools import setup\nsetup(name='{name}', version='1.0', packages=['{name}'],\n"
                f"      data_files=[('share/{name}', ['package.xml'])], entry_points={{'console_scripts': ['{name} = {name}:main']}})\n")
        code, out, err = self.run_command('talk', 'show')
        self.assertEqual((code, err), (0, ''), out)
        installed = {str(path.relative_to(self.folder / 'install')) for path in (self.folder / 'install').rglob('*') if path.is_file()}
        self.assertLessEqual({'talk/bin/talk', 'talk/share/talk/package.xml', 'show/lib/show/show', 'show/share/show/package.xml'}, installed)
        self.assertEqual([name for name in installed if '/local/' in name], [])

    def test_compile_with_ccache_if_it_is_there(self):
        (self.folder / 'bin').mkdir()
        (self.folder / 'bin/ccache').write_text('#!/bin/sh\n')
        (self.folder / 'bin/ccache').chmod(0o755)
        launcher = '-DCMAKE_CXX_COMPILER_LAUNCHER=ccache'

        def arguments(*words, **variables):
            with unittest.mock.patch.dict(os.environ, PATH=f"{self.folder}/bin:{os.environ['PATH']}", **variables):
                for name in ('CMAKE_C_COMPILER_LAUNCHER', 'CMAKE_CXX_COMPILER_LAUNCHER'):
                    if name not in variables:
                        os.environ.pop(name, None)
                self.assertEqual(self.run_command('arm', *words)[0], 0)
            return json.loads((self.folder / 'build/arm/launch_build_arguments.json').read_text())

        self.assertIn(launcher, arguments())
        self.assertNotIn(launcher, arguments('--no-ccache'))
        self.assertNotIn(launcher, arguments(CMAKE_CXX_COMPILER_LAUNCHER='distcc'))
        self.assertNotIn(launcher, arguments('--cmake-args', '-DCMAKE_CXX_COMPILER_LAUNCHER=distcc'))


class Estimates(InFolder):
    def test_are_made_from_the_last_build_and_from_this_one(self):
        for name, seconds in (('a', '10'), ('b', '30'), ('c', 'broken')):
            (self.folder / name).mkdir()
            (self.folder / name / FILE).write_text(seconds)
        estimate = Estimate(['a', 'b', 'c', 'd'], self.folder)
        self.assertIsNone(estimate.seconds_left(1))
        estimate.ended('a', 20, built=True)
        self.assertEqual((self.folder / 'a' / FILE).read_text(), '20.0\n')
        self.assertEqual(estimate.seconds_left(20), 30 + 20 + 20)  # c and d take as long as the others
        self.assertEqual(estimate.seconds_left(10), 35)  # two at the same time
        estimate.ended('c', 2, built=False)
        self.assertEqual((self.folder / 'c' / FILE).read_text(), 'broken')

    def test_in_words(self):
        self.assertEqual([in_words(seconds) for seconds in (0, 42.3, 600, 9000)],
                         ['about 1 s left', 'about 42 s left', 'about 10 min left', 'about 2.5 h left'])


class DebianPackages(InFolder):
    def setUp(self):
        super().setUp()
        self.package('arm', '<depend>eigen</depend>', '<depend>libfoo-dev</depend>', '<depend>base</depend>', '<depend>std_msgs</depend>',
                     '<test_depend>python3-bar</test_depend>')
        self.package('base', '<depend>libx11</depend>', '<build_depend>tinyxml2</build_depend>')
        (self.folder / 'prefix/share/tinyxml2').mkdir(parents=True)
        (self.folder / 'bin').mkdir()
        self.dpkg("echo 'libeigen3-dev installed'; echo 'libx11-dev config-files'; exit 1")

    def dpkg(self, script):
        (self.folder / 'bin/dpkg-query').write_text(f'#!/bin/sh\necho "$@" > asked\n{script}\n')
        (self.folder / 'bin/dpkg-query').chmod(0o755)
        patch = unittest.mock.patch.dict(os.environ, PATH=f"{self.folder}/bin:{os.environ['PATH']}")
        patch.start()
        self.addCleanup(patch.stop)

    def test_that_are_missing(self):
        packages = find_packages([self.folder / 'src'], {})
        prefixes = [self.folder / 'prefix']
        self.assertEqual(missing_packages(in_order(packages), packages, prefixes, tests=True),
                         {'arm': ['libfoo-dev', 'python3-bar'], 'base': ['libx11-dev']})
        self.assertTrue((self.folder / 'asked').read_text().endswith(' libeigen3-dev libfoo-dev libx11-dev python3-bar\n'))
        self.assertEqual(missing_packages(in_order(packages), packages, prefixes, tests=False),
                         {'arm': ['libfoo-dev'], 'base': ['libx11-dev']})

    def test_are_listed_for_apt(self):
        code, out, err = self.run_command('--missing')
        self.assertEqual((code, out, err), (0, 'libfoo-dev\nlibtinyxml2-dev\nlibx11-dev\npython3-bar\n', ''))

    def test_are_told_before_the_build_and_at_a_package_that_fails(self):
        for name in ('arm', 'base'):
            (self.folder / 'src' / name / 'CMakeLists.txt').write_text(
                f'cmake_minimum_required(VERSION 3.16)\nproject({name} NONE)\nmessage(FATAL_ERROR no)\n')
        with unittest.mock.patch('launch_build.__main__.write_setup_files'):
            code, out, _ = self.run_command('base', '--no-tests')
        self.assertEqual(code, 1)
        self.assertEqual(out.splitlines()[0],
                         'not installed, though 1 package of the workspace needs it: sudo apt install libtinyxml2-dev libx11-dev')
        self.assertIn('    all of it: build/base/launch_build_configure.log\n    not installed: libtinyxml2-dev, libx11-dev\n', out)

    def test_of_keys(self):
        self.assertEqual(debian_packages('eigen'), ['libeigen3-dev'])
        self.assertEqual(debian_packages('libyaml-cpp-dev'), ['libyaml-cpp-dev'])
        self.assertEqual([debian_packages(key) for key in ('std_msgs', 'libcurl_vendor', 'libmavconn', 'ament_cmake')], [[]] * 4)
        self.assertEqual([name for names in KEYS.values() for name in names if not re.fullmatch(r'[a-z0-9][a-z0-9.+-]+', name)], [])

    def test_on_a_system_without_dpkg(self):
        packages = find_packages([self.folder / 'src'], {})
        with unittest.mock.patch('subprocess.run', side_effect=FileNotFoundError):
            self.assertEqual(missing_packages(in_order(packages), packages, [], tests=True), {})


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
