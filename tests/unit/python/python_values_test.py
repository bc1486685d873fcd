# SPDX-License-Identifier: Apache-2.0
"""
Python launch files against the launcher itself: no value ends it by a signal, and no output gets into a result.

LAUNCH_PROGRAM is the launcher.
"""

import json
import os
import pathlib
import resource
import signal
import subprocess
import tempfile
import unittest

LAUNCH = os.environ['LAUNCH_PROGRAM']
EVERY_VALUE = pathlib.Path(__file__).with_name('every_value.launch.py')


def _limits():
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


class PythonValues(unittest.TestCase):

    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.directory = pathlib.Path(directory.name)
        self.environment = {**os.environ, 'ROS_LOG_DIR': str(self.directory / 'log')}

    def launch(self, *words, **variables):
        return subprocess.run([LAUNCH, *map(str, words)], capture_output=True, text=True, timeout=500, cwd=self.directory,
                              errors='replace', stdin=subprocess.DEVNULL, preexec_fn=_limits,
                              env={**self.environment, **variables})

    def file(self, items, before=''):
        path = self.directory / 'system.launch.py'
        path.write_text('import os\nimport subprocess\nfrom launch import *\nfrom launch.actions import *\n'
                        'from launch.event_handlers import *\nfrom launch.substitutions import *\n'
                        f'from launch_ros.actions import *\n{before}\n\n'
                        f'def generate_launch_description():\n    return LaunchDescription([\n{items}])\n')
        return path

    def test_no_value_ends_the_launcher_by_a_signal(self):
        progress, names = self.directory / 'progress', self.directory / 'names'
        done = self.launch('check', '--format', 'json', EVERY_VALUE, EVERY_VALUE_PROGRESS=str(progress),
                           EVERY_VALUE_NAMES=str(names))
        tried = names.read_text().split('\n')
        last = int(progress.read_text())
        self.assertEqual(done.returncode, 1, f'the last case was {last}: {tried[last]}\n{done.stderr[-2000:]}')
        self.assertEqual(last + 1, len(tried))
        self.assertGreater(len(tried), 10000)
        self.assertGreater(len(json.loads(done.stdout)), 1000)

    def test_an_error_has_the_line(self):
        # Each value with three classes, each class with two or three values. Above, all are tried in one launch.
        values = ('None', '5', 'b"x"', '{"a"}', '"a\\0b"', '["a", None]', 'object()', '"\\ud800"')
        names = ('EnvironmentVariable', 'LaunchConfiguration', 'FindExecutable', 'Command', 'PythonExpression',
                 'FileContent', 'AnonName', 'LocalSubstitution', 'PathJoinSubstitution')
        for number, value in enumerate(values):
            for name in names[number % 3::3]:
                with self.subTest(f'{name}({value})'):
                    done = self.launch('--dry-run', self.file(f'        LogInfo(msg={name}({value}))'))
                    self.assertEqual(done.returncode, 1, done.stderr)
                    self.assertIn('system.launch.py:12:', done.stderr)

    def test_a_running_system_ends_with_an_error(self):
        for items in ('TimerAction(period=0.1, actions=[OpaqueFunction(function=wrong)])',
                      'ExecuteProcess(cmd=["true"], on_exit=lambda event, context: [wrong()])',
                      'RegisterEventHandler(OnProcessStart(on_start=wrong)), ExecuteProcess(cmd=["sleep", "9"])',
                      'TimerAction(period=0.1, actions=[PopEnvironment()])'):
            with self.subTest(items):
                path = self.file(items, 'def wrong(*_args):\n    return LogInfo(msg=EnvironmentVariable(None))\n')
                done = self.launch(path)
                self.assertEqual(done.returncode, 1, done.stderr)
                self.assertIn('error: ', done.stderr)

    def test_output_of_a_file_is_not_in_the_result(self):
        path = self.file('OpaqueFunction(function=say), DeclareLaunchArgument("a", default_value="1")', """
def say(context):
    print('visited')

print('loaded')
os.system('echo a shell')
subprocess.run(['echo', 'a program'])
os.write(1, b'a write')
""")
        said = ('loaded', 'a shell', 'a program', 'a write')
        for words in (['--dry-run'], ['--dry-run=json'], ['--dry-run=shell'], ['check', '--format', 'json'],
                      ['check', '--format', 'sarif'], ['graph'], ['--show-args'], ['--print'], ['complete']):
            with self.subTest(words[0]):
                done = self.launch(*words, path, *(['a'] if words == ['complete'] else []))
                self.assertEqual(done.returncode, 0, done.stderr)
                for text in said:
                    self.assertNotIn(text, done.stdout)
                    self.assertIn(text, done.stderr)
                if 'json' in words[-1]:
                    json.loads(done.stdout)
        self.assertEqual(self.launch('complete', path, 'a').stdout, 'a:=\n')
        self.assertIn('visited', self.launch('--dry-run=json', path).stderr)

    def test_a_closed_descriptor_is_no_obstacle(self):
        path = self.file('ExecuteProcess(cmd=["true"])')
        for closed in ('>&-', '2>&-', '>&- 2>&-'):
            done = subprocess.run(f'exec {LAUNCH} --dry-run=json {path} {closed}', shell=True, capture_output=True, text=True)
            self.assertGreaterEqual(done.returncode, 0, closed)
            if closed == '2>&-':
                json.loads(done.stdout)


if __name__ == '__main__':
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    unittest.main()
