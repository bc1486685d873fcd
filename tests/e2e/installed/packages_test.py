# SPDX-License-Identifier: Apache-2.0
"""
What the packages of Debian hold, if `./dev package` has made them here or for another system; otherwise this is skipped.
packages/check_install installs and uses them, which needs a system to throw away.
"""

import os
import re
import shutil
import subprocess
import unittest
from pathlib import Path

SOURCE = Path(os.environ['SOURCE_DIRECTORY'])
NAMES = ('launch-tools', 'launch-twin', 'launch-companion', 'launch-stack', 'launch-stack-dev', 'python3-launch-trace')


def folder_of_packages():
    """The folder with the newest packages, or None."""
    found = [*SOURCE.glob('build/packages/launch-tools_*.deb'), *SOURCE.glob('build/systems/*/build/packages/launch-tools_*.deb')]
    return max(found, key=lambda path: path.stat().st_mtime).parent if found else None


class Packages(unittest.TestCase):

    @staticmethod
    def architecture():
        return subprocess.run(['dpkg', '--print-architecture'], capture_output=True, text=True, check=True).stdout.strip()

    @classmethod
    def setUpClass(cls):
        folder = folder_of_packages()
        if not folder:
            raise unittest.SkipTest('no packages in build/packages: ./dev package makes them')
        if not shutil.which('dpkg-deb'):
            raise unittest.SkipTest('no dpkg-deb, which tells what a package holds')
        version = re.search(r'^project\(launch VERSION (\S+)', (SOURCE / 'CMakeLists.txt').read_text(), re.M)[1]
        if not (folder / f'launch-tools_{version}_{cls.architecture()}.deb').exists():
            raise unittest.SkipTest(f'the packages in {folder} are not of version {version}')
        cls.fields, cls.files, cls.links = {}, {}, {}
        for name in NAMES:
            package, = folder.glob(f'{name}_*.deb')
            control = subprocess.run(['dpkg-deb', '-f', package], capture_output=True, text=True, check=True).stdout
            cls.fields[name] = dict(re.findall(r'^([A-Za-z-]+): (.*)', control, re.M))
            listing = subprocess.run(['dpkg-deb', '-c', package], capture_output=True, text=True, check=True).stdout
            cls.files[name] = set()
            for line in listing.splitlines():
                kind, path = line[0], line.split(None, 5)[5].removeprefix('.')
                if kind == 'l':
                    path, target = path.split(' -> ')
                    cls.links[path] = target
                if kind != 'd':
                    cls.files[name].add(path)

    def test_every_package_of_the_description_is_there(self):
        described = re.findall(r'^Package: (.*)', (SOURCE / 'debian/control').read_text(), re.M)
        self.assertEqual(sorted(described), sorted(NAMES))

    def test_the_tools(self):
        for path in ('/opt/launch/bin/launch', '/opt/launch/lib/launch/launch-guardian', '/opt/launch/lib/launch/launch-report', '/opt/launch/lib/launch/launch-test',
                     '/opt/launch/lib/launch/liblaunch_python.so',
                     '/usr/share/man/man1/launch.1.gz', '/usr/share/man/man1/launch-report.1.gz', '/usr/share/bash-completion/completions/launch',
                     '/usr/share/zsh/vendor-completions/_launch', '/usr/share/fish/vendor_completions.d/launch.fish', '/opt/launch/share/launch/schema/launch.xsd',
                     '/opt/launch/share/launch_examples/01_ping_pong.launch.xml', '/usr/share/doc/launch-tools/copyright'):
            self.assertIn(path, self.files['launch-tools'])
        self.assertEqual(self.links['/usr/bin/launch'], '/opt/launch/bin/launch')

    def test_the_companion_has_its_sources_alone(self):
        share = '/opt/launch/share/launch/launch_companion/'
        self.assertLessEqual({share + 'package.xml', share + 'CMakeLists.txt', share + 'version'}, self.files['launch-companion'])
        for path in self.files['launch-companion']:
            self.assertTrue(path.startswith((share, '/usr/share/doc/launch-companion/', '/usr/share/lintian/overrides/launch-companion')), path)
        self.assertEqual([path for path in self.files['launch-tools'] if path.startswith(share)], [])

    def test_the_twin_is_apart(self):
        self.assertLessEqual({'/opt/launch/lib/launch/launch-twin', '/opt/launch/lib/launch_twin/twin_node', '/usr/share/man/man1/launch-twin.1.gz'},
                             self.files['launch-twin'])
        for name in ('launch-tools', 'launch-stack'):
            self.assertEqual([path for path in self.files[name] if 'twin' in path], [], name)

    def test_the_tools_are_small(self):
        self.assertLess(int(self.fields['launch-tools']['Installed-Size']) * 1024, 25e6)

    def test_the_stack(self):
        for path in ('/opt/launch/lib/librclcpp.so', '/opt/launch/lib/demo_nodes/ping', '/opt/launch/share/std_msgs/msg/String.msg', '/opt/launch/setup.bash',
                     '/opt/launch/share/ament_index/resource_index/packages/demo_nodes'):
            self.assertIn(path, self.files['launch-stack'])
        for path in ('/opt/launch/include/rclcpp/rclcpp/rclcpp.hpp', '/opt/launch/share/rclcpp/cmake/rclcppConfig.cmake', '/opt/launch/lib/liblaunch_trace_reader.so'):
            self.assertIn(path, self.files['launch-stack-dev'])

    def test_what_runs_needs_no_compiler(self):
        for name in ('launch-tools', 'launch-stack', 'python3-launch-trace'):
            with self.subTest(name):
                self.assertNotRegex(self.fields[name]['Depends'], r'-dev\b|g\+\+|\bgcc|cmake')
                self.assertEqual([path for path in self.files[name] if path.endswith(('.hpp', '.cmake', '.a'))], [])

    def test_the_dependencies_were_computed(self):
        for name, library in (('launch-tools', 'libc6'), ('launch-stack', 'libfast'), ('python3-launch-trace', 'libbabeltrace2')):
            self.assertIn(library, self.fields[name]['Depends'])
        self.assertIn('launch-stack (= ', self.fields['launch-tools']['Depends'])

    def test_no_file_is_in_two_packages(self):
        paths = [path for name in NAMES for path in self.files[name]]
        self.assertEqual(len(paths), len(set(paths)))

    def test_nothing_stands_where_a_ros_2_or_the_system_looks_for_its_own(self):
        for name in NAMES:
            for path in self.files[name]:
                self.assertRegex(path, r'^(/opt/launch/|/usr/(share|bin)/|/usr/lib/python3/dist-packages/launch_trace)')
                self.assertNotIn('__pycache__', path)
        commands = {path for paths in self.files.values() for path in paths if path.startswith('/usr/bin/')}
        self.assertEqual(commands, {'/usr/bin/launch', '/usr/bin/launch_test'})

    def test_the_container_installs_packages_that_exist(self):
        names = set(re.findall(r'/([a-z0-9-]+)_\*\.deb', (SOURCE / 'packages/Containerfile').read_text()))
        self.assertLessEqual({'launch-tools'}, names)
        self.assertLessEqual(names, set(NAMES))


if __name__ == '__main__':
    unittest.main()
