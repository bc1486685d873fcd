# SPDX-License-Identifier: Apache-2.0
"""What the packages do in a Python program where no launch runs, such as a test of pytest of a package."""

import os
import shutil
import subprocess
import sys
import tempfile
import textwrap
import unittest
from pathlib import Path

PACKAGES = os.environ['LAUNCH_PACKAGES']
HEAD = '''
import os
from launch import LaunchContext, LaunchDescription
from launch.actions import *
from launch.conditions import *
from launch.substitutions import *
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
context = LaunchContext()
def fails(substitution):
    try:
        return 'performed: ' + substitution.perform(context)
    except SubstitutionFailure as failure:
        return str(failure)
'''


class OutsideTest(unittest.TestCase):

    def setUp(self):
        self.directory = Path(tempfile.mkdtemp(prefix='python_outside_test-'))
        self.addCleanup(shutil.rmtree, self.directory)
        prefix = self.directory / 'prefix'
        (prefix / 'share/ament_index/resource_index/packages').mkdir(parents=True)
        (prefix / 'share/ament_index/resource_index/packages/arm').touch()
        (prefix / 'share/arm').mkdir()
        (prefix / 'lib/arm').mkdir(parents=True)
        (prefix / 'lib/arm/move').touch(mode=0o755)
        self.environment = {'PATH': os.environ['PATH'], 'HOME': str(self.directory), 'PYTHONPATH': PACKAGES,
                            'AMENT_PREFIX_PATH': str(prefix), 'PYTHONDONTWRITEBYTECODE': '1'}

    def output_of(self, program, head=HEAD, **environment):
        done = subprocess.run([sys.executable, '-c', head + textwrap.dedent(program)], capture_output=True, text=True, check=False,
                              env={**self.environment, **environment})
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout.replace(str(self.directory), 'DIR')

    def test_substitutions_have_values(self):
        self.assertEqual(self.output_of('''
            context.launch_configurations['speed'] = '2'
            speed = LaunchConfiguration('speed')
            for substitution in (
                    speed, LaunchConfiguration('name', default=['arm', speed]), PathJoinSubstitution(['a', speed]),
                    EnvironmentVariable('HOME'), EnvironmentVariable('NO', default_value='none'),
                    PythonExpression([speed, ' * pi > 6']), Command('echo word'), NotSubstitution('True'),
                    AndSubstitution('true', '0'), OrSubstitution('true', '0'), EqualsSubstitution('1.0', '1'),
                    NotEqualsSubstitution('a', 'b'), IfElseSubstitution('1', 'yes', 'no'), FindExecutable(name='sh'),
                    StringJoinSubstitution(['a', speed], delimiter='-')):
                print(substitution.perform(context).strip())
            print(perform_substitutions(context, normalize_to_list_of_substitutions(['x', speed])))
            print(context.perform_substitution(speed))
            print(IfCondition(EqualsSubstitution(speed, 2)).evaluate(context), LaunchConfigurationEquals('speed', '3').evaluate(context))
        ''').replace('/usr/bin/sh', '/bin/sh').split('\n'), [
            '2', 'arm2', 'a/2', 'DIR', 'none', 'True', 'word', 'false', 'false', 'true', 'true', 'true', 'yes', '/bin/sh', 'a-2', 'x2', '2',
            'True False', ''])

    def test_substitutions_fail_as_in_a_launch(self):
        self.assertEqual(self.output_of('''
            for substitution in (LaunchConfiguration('no'), EnvironmentVariable('NO'), PythonExpression('1 +'), Command('false'),
                                 Command('sh -c "echo a >&2"'), FindExecutable(name='no_such_program'), FileContent('none'),
                                 NotSubstitution('maybe'), ThisLaunchFileDir()):
                print(fails(substitution))
        ''').split('\n'), [
            "launch configuration 'no' does not exist", "environment variable 'NO' does not exist",
            "failed to evaluate the Python expression '1 +': SyntaxError: invalid syntax (<string>, line 1)",
            "executing command 'false' failed: exit code 1",
            "executing command 'sh -c \"echo a >&2\"' failed: it wrote to standard error",
            "executable 'no_such_program' not found on the PATH", "file not found: 'none'",
            "'maybe' is no boolean, expected true, false, 1 or 0", 'ThisLaunchFileDir has a value only while a launch runs', ''])

    def test_packages_are_found(self):
        self.assertEqual(self.output_of('''
            from ament_index_python.packages import *
            from launch_ros.substitutions import ExecutableInPackage, FindPackagePrefix, FindPackageShare
            print(get_package_share_directory('arm'), get_package_prefix('arm'), get_package_share_path('arm').name)
            print(FindPackageShare('arm').perform(context), FindPackagePrefix('arm').find('arm'))
            print(ExecutableInPackage('move', 'arm').perform(context), (FindPackageShare('arm') / 'urdf').perform(context))
            print(fails(FindPackageShare('leg')))
            try:
                get_package_prefix('leg')
            except PackageNotFoundError as error:
                print(error)
        '''), '''\
DIR/prefix/share/arm DIR/prefix arm
DIR/prefix/share/arm DIR/prefix
DIR/prefix/lib/arm/move DIR/prefix/share/arm/urdf
package 'leg' not found, searching: ['DIR/prefix']
package 'leg' not found, searching: ['DIR/prefix']
''')

    def test_the_index_needs_no_launch(self):
        self.assertEqual(self.output_of('''
            import sys
            from ament_index_python import get_package_share_directory
            print(get_package_share_directory('arm'), 'launch' in sys.modules)
        ''', head=''), 'DIR/prefix/share/arm False\n')

    def test_actions_that_change_the_context_do(self):
        self.assertEqual(self.output_of('''
            LaunchDescription([]).visit(context)
            for action in (DeclareLaunchArgument('robot', default_value='arm'), SetLaunchConfiguration('speed', ['1', '2']),
                           SetLaunchConfiguration('gone', '1'), UnsetLaunchConfiguration('gone'), SetEnvironmentVariable('COLOUR', 'red'),
                           SetLaunchConfiguration('never', '1', condition=IfCondition('false'))):
                action.visit(context)
            print(context.launch_configurations, os.environ['COLOUR'], EnvironmentVariable('COLOUR').perform(context))
            try:
                DeclareLaunchArgument('must').visit(context)
            except RuntimeError as error:
                print(error)
        '''), "{'robot': 'arm', 'speed': '12'} red red\nRequired launch argument 'must' was not provided\n")

    def test_launch_files_can_be_read(self):
        path = self.directory / 'a.launch.py'
        path.write_text('from launch import LaunchDescription\nfrom launch.actions import DeclareLaunchArgument\n'
                        'def generate_launch_description():\n    return LaunchDescription([DeclareLaunchArgument("robot")])\n')
        self.assertEqual(self.output_of(f'''
            from launch.launch_description_sources import PythonLaunchDescriptionSource
            source = PythonLaunchDescriptionSource(['{self.directory}/', 'a.launch.py'])
            print([argument.name for argument in source.get_launch_description(context).get_launch_arguments()])
        '''), "['robot']\n")

    def test_logs_would_be_below_the_home(self):
        program = 'import launch.logging; print(launch.logging.launch_config.log_dir)'
        self.assertEqual(self.output_of(program), 'DIR/.ros/log\n')
        self.assertEqual(self.output_of(program, ROS_LOG_DIR='/logs'), '/logs\n')


if __name__ == '__main__':
    unittest.main()
