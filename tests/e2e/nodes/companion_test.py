# SPDX-License-Identifier: Apache-2.0
"""launch_companion: the package is built as a user builds it, and asks nodes.

Against this stack it must pass the tests of the programs that it stands in for. Against another ROS 2, whose prefix is
TEST_ROS2_PREFIX, it asks a container and loads a component that is built for the test.
"""

import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import unittest

BUILD = pathlib.Path(os.environ['BUILD_DIRECTORY'])
SOURCES = pathlib.Path(os.environ['SOURCE_DIRECTORY'])
LAUNCH = os.environ['LAUNCH_PROGRAM']
BUILD_TIMEOUT = 1500
PATIENCE = 60


def build(workspace, packages, environment, installed):
    """Builds packages with the `launch build` of this prefix. The workspace stays, so that the next run takes less time."""
    source = workspace / 'src'
    source.mkdir(parents=True, exist_ok=True)
    for package in packages:
        link = source / package.name
        if not link.exists():
            link.symlink_to(package)
    result = subprocess.run([installed, '-C', workspace, '--no-tests', '--cmake-args', '-DCMAKE_BUILD_TYPE=Debug'],
                            env={**os.environ, 'PYTHONDONTWRITEBYTECODE': '1', **environment}, capture_output=True, text=True,
                            timeout=BUILD_TIMEOUT, stdin=subprocess.DEVNULL, check=False)
    assert result.returncode == 0, result.stdout + result.stderr
    return [workspace / 'install' / package.name for package in packages]


class OnThisStack(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.prefix = BUILD / 'companion/prefix'
        for part in ('instrumented_stack', 'programs/build', 'programs/companion'):
            subprocess.run(['cmake', '--install', BUILD / part, '--prefix', cls.prefix], capture_output=True, check=True)
        [companion] = build(BUILD / 'companion/workspace', [cls.prefix / 'share/launch/launch_companion'],
                            {'AMENT_PREFIX_PATH': '', 'CMAKE_PREFIX_PATH': ''}, cls.prefix / 'lib/launch/launch-build')
        cls.environment = {**os.environ, 'TEST_AMENT_PREFIX_PATH': f'{companion}:{BUILD}/prefix'}

    def run_cases(self, program, filtered='*'):
        result = subprocess.run([BUILD / 'tests' / program, '--gtest_filter=' + filtered], env=self.environment, capture_output=True,
                                text=True, timeout=600, stdin=subprocess.DEVNULL, check=False)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.assertRegex(result.stdout, r'\[  PASSED  \] [1-9][0-9]* test')

    def test_it_answers_a_launch_as_our_own_does(self):
        self.run_cases('unit/ros/ros_client_test', 'RosClient*')

    def test_its_commands_are_those_of_our_own(self):
        self.run_cases('e2e/nodes/graph_commands_test')


class OnAnotherRos2(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if not os.environ.get('TEST_ROS2_PREFIX'):
            raise unittest.SkipTest('skipped, because TEST_ROS2_PREFIX names no prefix of another ROS 2')
        prefix = os.environ['TEST_ROS2_PREFIX']
        libraries = f'{prefix}/lib'
        temporary = tempfile.mkdtemp()
        cls.addClassCleanup(shutil.rmtree, temporary)
        found = {'AMENT_PREFIX_PATH': prefix, 'CMAKE_PREFIX_PATH': prefix, 'LD_LIBRARY_PATH': libraries}
        packages = [BUILD / 'prefix/share/launch/launch_companion', SOURCES / 'tests/e2e/nodes/companion_part']
        installed = build(BUILD / 'companion/other', packages, found, BUILD / 'prefix/lib/launch/launch-build')
        cls.environment = {**os.environ, 'HOME': temporary, 'ROS_LOG_DIR': temporary, 'XDG_RUNTIME_DIR': temporary,
                           'LD_LIBRARY_PATH': f'{libraries}:{installed[1]}/lib', 'ROS_DOMAIN_ID': str(100 + os.getpid() % 100),
                           'AMENT_PREFIX_PATH': ':'.join([*map(str, installed), prefix])}
        cls.file = pathlib.Path(temporary) / 'system.launch.xml'
        cls.file.write_text('''<launch>
  <node_container pkg="rclcpp_components" exec="component_container" name="box" namespace=""/>
  <load_composable_node target="/box">
    <composable_node pkg="companion_part" plugin="companion_part::Part" name="part"><param name="gain" value="2.5"/></composable_node>
  </load_composable_node>
</launch>
''', encoding='utf-8')

    def ask(self, *words):
        result = subprocess.run([LAUNCH, *words], env=self.environment, capture_output=True, text=True, timeout=PATIENCE,
                                stdin=subprocess.DEVNULL, check=False)
        return result.stdout + result.stderr

    def test_it_loads_a_component_and_asks_it(self):
        with subprocess.Popen([LAUNCH, self.file], env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              text=True) as system:
            try:
                said = ''
                for line in system.stdout:
                    said += line
                    if 'the part is loaded' in line:
                        break
                self.assertIn('the part is loaded', said)
                nodes = self.ask('node', 'list').split()
                self.assertIn('/box', nodes)
                self.assertIn('/part', nodes)
                self.assertEqual(self.ask('component', 'list'), '/box\n  1  /part\n')
                self.assertEqual(self.ask('param', 'get', '/part', 'gain'), 'Double value is: 2.5\n')
                self.assertEqual(self.ask('param', 'set', '/part', 'gain', '3.5'), 'Set parameter successful\n')
                self.assertEqual(self.ask('service', 'type', '/part/get_parameters'), 'rcl_interfaces/srv/GetParameters\n')
                answer = self.ask('service', 'call', '/part/get_parameters', 'rcl_interfaces/srv/GetParameters', '{names: [gain]}')
                self.assertIn('double_value=3.5', answer)
                self.assertRegex(self.ask('topic', 'echo', '--once', '/numbers'), r'^data: [0-9]+\n---\n$')
                self.assertIn('Publisher count: 1\n', self.ask('topic', 'info', '/numbers'))
                self.assertEqual(self.ask('component', 'unload', '/box', '1'), "Unloaded component 1 from '/box' container node\n")
            finally:
                system.send_signal(signal.SIGINT)
                system.stdout.read()
            self.assertEqual(system.wait(), 0)

    def test_it_reads_what_it_has_written(self):
        echo = subprocess.Popen([LAUNCH, 'topic', 'echo', '--once', '/said', 'rcl_interfaces/msg/ParameterEvent'], env=self.environment,
                                stdout=subprocess.PIPE, text=True)
        self.ask('topic', 'pub', '--times', '3', '-w', '1', '/said', 'rcl_interfaces/msg/ParameterEvent',
                 '{node: /left, new_parameters: [{name: gain, value: {type: 3, double_value: 0.1}}, '
                 '{name: names, value: {type: 9, string_array_value: [a, "ü"]}}]}')
        with echo:
            said = echo.stdout.read()
        self.assertIn('node: /left\n', said)
        self.assertIn('double_value: 0.1\n', said)
        self.assertIn('- a\n', said)
        self.assertIn('- ü\n', said)


if __name__ == '__main__':
    unittest.main()
