# SPDX-License-Identifier: Apache-2.0
"""
Launches that Python of their launch file ends: the guardian tells where, ends what has started, and the exit code is not 0. LAUNCH_PROGRAM is
the launcher.
"""

import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import unittest

LAUNCH = os.environ['LAUNCH_PROGRAM']
AT_START = '''from launch import LaunchDescription
from launch.actions import ExecuteProcess, OpaqueFunction, RegisterEventHandler
from launch.event_handlers import OnProcessStart
import ctypes, os, sys, threading
def generate_launch_description():
    process = ExecuteProcess(cmd=['sleep', '98765'])
    return LaunchDescription([process, RegisterEventHandler(OnProcessStart(
        target_action=process, on_start=[OpaqueFunction(function=act)]))])
def act(context):
    {}
'''


def error(place, line, what, last=''):
    """The error as it is told."""
    file, number, column = place.split(':')
    indent = ' ' * (int(column) - 1)
    return (f'{file}:{number}:{column}: error: {what}\n{number:>5} | {line}\n      | {indent}^{"~" * (len(line) - int(column))}\n' + last)


class PythonEndsLaunch(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.directory = pathlib.Path(directory.name)

    def launch(self, text, *options, name='a.launch.py'):
        (self.directory / name).write_text(text, encoding='utf-8')
        result = subprocess.run([LAUNCH, *options, name], cwd=self.directory, capture_output=True, text=True, check=False, timeout=120,
                                env={**os.environ, 'ROS_LOG_DIR': str(self.directory / 'log')})
        for left in ('sleep 98765', 'sleep 87654'):
            self.assertEqual(subprocess.run(['pgrep', '-fx', left], capture_output=True, check=False).stdout, b'')
        return result

    def test_abort_while_the_file_is_read(self):
        result = self.launch('import os\n\ndef generate_launch_description():\n    os.abort()\n')
        self.assertEqual(result.stderr, error('a.launch.py:4:5', '    os.abort()', 'Python ends the launch here by SIGABRT'))
        self.assertEqual(result.returncode, -signal.SIGABRT)

    def test_an_exit_with_code_0_is_none(self):
        result = self.launch('import os\nos._exit(0)\n')
        self.assertEqual(result.stderr, error('a.launch.py:2:1', 'os._exit(0)', 'Python ends the launch here, with exit code 0'))
        self.assertEqual(result.returncode, 1)

    def test_another_exit_code_stays(self):
        result = self.launch('import os\nos._exit(7)\n')
        self.assertEqual(result.stderr, error('a.launch.py:2:1', 'os._exit(7)', 'Python ends the launch here, with exit code 7'))
        self.assertEqual(result.returncode, 7)

    def test_a_child_that_goes_on_with_the_file_is_no_second_launch(self):
        text = ('import os\nfrom launch import LaunchDescription\nfrom launch.actions import ExecuteProcess\nos.fork()\n'
                "def generate_launch_description():\n    return LaunchDescription([ExecuteProcess(cmd=['sh', '-c', 'echo begun >> begun'])])\n")
        self.assertEqual(self.launch(text).returncode, 0)
        self.assertEqual((self.directory / 'begun').read_text(encoding='utf-8'), 'begun\n')

    def check_at_start(self, code, what, returncode):
        """What has started is ended; the error is in the log, too."""
        result = self.launch(AT_START.format(code))
        expected = error('a.launch.py:10:5', '    ' + code, what)
        self.assertEqual(result.stderr, expected)
        self.assertIn('Python has ended the launcher: ending 1 process\n', result.stdout)
        self.assertEqual(result.returncode, returncode)
        logs = [path.read_text(encoding='utf-8') for path in (self.directory / 'log').glob('*/launch.log') if not path.parent.is_symlink()]
        self.assertEqual(len(logs), 1)
        self.assertIn(expected, logs[0])

    def test_exit_when_a_process_has_started(self):
        self.check_at_start('os._exit(0)', 'Python ends the launch here, with exit code 0', 1)

    def test_abort_when_a_process_has_started(self):
        self.check_at_start('os.abort()', 'Python ends the launch here by SIGABRT', -signal.SIGABRT)

    def test_null_pointer_when_a_process_has_started(self):
        self.check_at_start('ctypes.string_at(0)', 'Python ends the launch here by SIGSEGV', -signal.SIGSEGV)

    def test_exit_in_a_thread(self):
        self.check_at_start('threading.Thread(target=lambda: os._exit(0)).start(), threading.Event().wait()',
                            'Python ends the launch here, with exit code 0', 1)

    def test_descriptors_of_the_launcher(self):
        result = self.launch(AT_START.format('os.closerange(0, 1000)'))
        self.assertEqual(result.stderr, error('a.launch.py:1:1', 'from launch import LaunchDescription',
                                              "this file closes descriptors of the launcher, which can't go on without them"))
        self.assertIn('Python has ended the launcher: ending 1 process\n', result.stdout)
        self.assertEqual(result.returncode, 1)

    def test_standard_descriptors_may_be_closed(self):
        result = self.launch('import os\nos.close(0), os.close(1)\n' + AT_START.format('os.write(2, b"still here\\n"), sys.exit(0)'))
        self.assertIn('still here\n', result.stderr)
        self.assertNotIn('Python ends the launch', result.stderr)

    def test_an_endless_loop_ends_when_the_user_wants_a_limit(self):
        result = self.launch('def generate_launch_description():\n    while True: pass\n', '--python-seconds', '1')
        self.assertEqual(result.stderr, error('a.launch.py:2:5', '    while True: pass', 'Python runs here for more than 1 s, and was ended',
                                              '      = help: --python-seconds gives it more time\n'))
        self.assertEqual(result.returncode, 1)

    def test_an_expression_has_a_limit_of_time(self):
        result = self.launch('''<launch><log message="$(eval '9 ** 9 ** 9')"/></launch>''', '--python-seconds', '1', name='b.launch.xml')
        self.assertEqual(result.stderr, 'b.launch.xml:1:30: error: Python runs here for more than 1 s, and was ended\n'
                         '    1 | <launch><log message="$(eval \'9 ** 9 ** 9\')"/></launch>\n'
                         '      |                              ^\n'
                         '      = help: --python-seconds gives it more time\n')
        self.assertEqual(result.returncode, 1)

    def test_and_one_of_memory(self):
        result = self.launch('''<launch><log message="$(eval '&quot;a&quot; * 4000000000')"/></launch>''', name='b.launch.xml')
        self.assertIn("failed to evaluate the Python expression '\"a\" * 4000000000': MemoryError: ", result.stderr)
        self.assertIn('= help: --python-memory gives it more\n', result.stderr)
        self.assertEqual(result.returncode, 1)

    def test_an_expression_that_aborts(self):
        result = self.launch('''<launch><log message="$(eval '__import__(&quot;os&quot;).abort()')"/></launch>''', name='b.launch.xml')
        self.assertIn('b.launch.xml:1:30: error: Python ends the launch here by SIGABRT\n', result.stderr)
        self.assertEqual(result.returncode, -signal.SIGABRT)

    def test_a_command_has_a_limit_of_time(self):
        for option in ([], ['--dry-run']):
            with self.subTest(option=option):
                result = self.launch('''<launch><log message="$(command 'sh -c &quot;sleep 87654; true&quot;')"/></launch>''',
                                     *option, '--python-seconds', '1', name='b.launch.xml')
                self.assertIn("executing command 'sh -c \"sleep 87654; true\"' failed: it runs for more than 1 s, and was ended\n", result.stderr)
                self.assertIn('= help: --python-seconds gives it more time\n', result.stderr)
                self.assertEqual(result.returncode, 1)

    def test_and_one_of_what_it_writes(self):
        result = self.launch('''<launch><log message="$(command yes)"/></launch>''', name='b.launch.xml')
        self.assertIn("executing command 'yes' failed: it wrote more than 64 MiB, and was ended\n", result.stderr)
        self.assertEqual(result.returncode, 1)

    def test_a_file_that_includes_itself(self):
        text = '''from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
def generate_launch_description():
    return LaunchDescription([IncludeLaunchDescription(__file__)])
'''
        for option in ([], ['--dry-run']):
            with self.subTest(option=option):
                result = self.launch(text, *option)
                self.assertIn('a.launch.py:4:', result.stderr)
                self.assertIn('error: ', result.stderr)
                self.assertEqual(result.returncode, 1)

    def test_a_signal_from_outside_is_not_python_s(self):
        text = AT_START.format('os.kill(os.getpid(), 9)')
        result = self.launch(text)
        self.assertIn('the launcher was ended by SIGKILL: ending 1 process\n', result.stdout)
        self.assertEqual(result.returncode, -signal.SIGKILL)


if __name__ == '__main__':
    sys.exit(unittest.main())
