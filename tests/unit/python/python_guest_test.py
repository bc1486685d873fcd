# SPDX-License-Identifier: Apache-2.0
"""
Python launch files that end the process which runs them, looked at by commands that run nothing. LAUNCH_PROGRAM is the launcher.
"""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

LAUNCH = os.environ['LAUNCH_PROGRAM']
GOOD = '''from launch import LaunchDescription
def generate_launch_description():
    return LaunchDescription([])
'''


class PythonGuest(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.directory = pathlib.Path(directory.name)

    def write(self, text, name='a.launch.py'):
        (self.directory / name).write_text(text, encoding='utf-8')

    def launch(self, *words):
        return subprocess.run([LAUNCH, *words], cwd=self.directory, capture_output=True, text=True, check=False,
                              env={**os.environ, 'ROS_LOG_DIR': str(self.directory / 'log')})

    def check_is(self, expected, *options):
        """What `launch check` says of a.launch.py."""
        result = self.launch('check', *options, 'a.launch.py')
        self.assertEqual(result.stdout, expected + '1 file: 1 error, 0 warnings\n')
        self.assertEqual(result.stderr, '')
        self.assertEqual(result.returncode, 1)

    def test_a_signal_that_kills_is_an_error_at_its_line(self):
        self.write('import os\n\ndef generate_launch_description():\n    os.abort()\n')
        self.check_is('a.launch.py:4:5: error: Python ends here by SIGABRT [LF0005]\n'
                      '    4 |     os.abort()\n'
                      '      |     ^~~~~~~~~~\n'
                      '      = help: it would end a launch in the same way\n')

    def test_so_is_a_null_pointer_in_a_function_that_a_visit_calls(self):
        self.write('import ctypes\nfrom launch import LaunchDescription\nfrom launch.actions import OpaqueFunction\n'
                   'def point(context):\n    ctypes.string_at(0)\n'
                   'def generate_launch_description():\n'
                   '    return LaunchDescription([OpaqueFunction(function=point)])\n')
        self.check_is('a.launch.py:5:5: error: Python ends here by SIGSEGV [LF0005]\n'
                      '    5 |     ctypes.string_at(0)\n'
                      '      |     ^~~~~~~~~~~~~~~~~~~\n'
                      '      = help: it would end a launch in the same way\n')

    def test_an_exit_with_code_0_is_an_error(self):
        self.write('import os\nos._exit(0)\n')
        self.check_is('a.launch.py:2:1: error: Python ends the program here, with exit code 0 [LF0005]\n'
                      '    2 | os._exit(0)\n'
                      '      | ^~~~~~~~~~~\n'
                      '      = help: it would end a launch in the same way\n')

    def test_the_exit_of_a_child_is_none(self):
        self.write('import os\nif os.fork() == 0:\n    os._exit(0)\nos.wait()\n' + GOOD)
        result = self.launch('check', 'a.launch.py')
        self.assertEqual((result.stdout, result.returncode), ('1 file: 0 errors, 0 warnings\n', 0))

    def test_a_child_that_goes_on_with_the_file_ends_with_it(self):
        self.write('import os\nchild = os.fork()\nif child:\n    print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))\n' + GOOD)
        result = self.launch('check', 'a.launch.py')
        self.assertEqual((result.stdout, result.stderr, result.returncode), ('1 file: 0 errors, 0 warnings\n', '0\n', 0))

    def test_an_endless_loop_ends_at_the_limit(self):
        self.write('while True: pass\n')
        self.check_is('a.launch.py:1:1: error: Python runs here for more than 1 s, and was ended [LF0005]\n'
                      '    1 | while True: pass\n'
                      '      | ^~~~~~~~~~~~~~~~\n'
                      '      = help: --python-seconds gives it more time\n', '--python-seconds', '1')

    def test_memory_has_a_limit(self):
        self.write('all_of_it = "a" * 4000000000\n')
        self.check_is('a.launch.py:1:13: error: MemoryError: no message [LF0005]\n'
                      '    1 | all_of_it = "a" * 4000000000\n'
                      '      |             ^~~~~~~~~~~~~~~~\n'
                      '      = help: Python has 512 MB here; --python-memory gives it more\n', '--python-memory', '512M')

    def test_standard_output_stays_the_command_s(self):
        self.write('import os\nos.closerange(0, 1000)\n' + GOOD)
        self.check_is('a.launch.py:1:1: error: this file closes or replaces the standard output of the program that '
                      'looks at it [LF0005]\n'
                      '    1 | import os\n'
                      '      | ^\n')

    def test_an_expression_of_another_file_is_an_error_there(self):
        (self.directory / 'b.launch.xml').write_text(
            '''<launch><log message="$(eval '__import__(&quot;os&quot;).abort()')"/></launch>''')
        result = self.launch('check', 'b.launch.xml')
        self.assertIn("b.launch.xml:1:23: error: failed to evaluate the Python expression '__import__(\"os\").abort()': "
                      'Python ends here by SIGABRT [LF0203]\n', result.stdout)
        self.assertEqual(result.returncode, 1)

    def test_the_other_files_are_checked_all_the_same(self):
        self.write('import os\nos.abort()\n')
        self.write('import os\nos._exit(3)\n', 'b.launch.py')
        self.write('syntax error\n', 'c.launch.py')
        self.write(GOOD, 'd.launch.py')
        (self.directory / 'e.launch.xml').write_text('<launch><include file="a.launch.py"/><nope/></launch>')
        result = self.launch('check', '--format', 'json', '.')
        found = [(pathlib.Path(one['file']).name, one['line'], one['message']) for one in json.loads(result.stdout)]
        self.assertEqual(found, [('a.launch.py', 2, 'Python ends here by SIGABRT'),
                                 ('b.launch.py', 2, 'Python ends the program here, with exit code 3'),
                                 ('c.launch.py', 1, 'SyntaxError: invalid syntax'),
                                 ('e.launch.xml', 1, "unrecognized entity of the type 'nope'")])

    def test_each_command_that_only_looks_tells_it(self):
        self.write('import os\nos.abort()\n')
        for command in (['--dry-run'], ['--dry-run=json'], ['--print'], ['--show-args'], ['graph']):
            with self.subTest(command=command):
                result = self.launch(*command, 'a.launch.py')
                self.assertEqual(result.stdout, '')
                self.assertEqual(result.stderr, 'a.launch.py:2:1: error: Python ends here by SIGABRT\n'
                                                '    2 | os.abort()\n'
                                                '      | ^~~~~~~~~~\n'
                                                '      = help: it would end a launch in the same way\n')
                self.assertEqual(result.returncode, 1)

    def test_a_thread_that_ends_the_program_is_an_error(self):
        self.write('import os, threading\nrest = threading.Thread(target=lambda: os._exit(0))\n'
                   'rest.start()\nrest.join()\n' + GOOD)
        result = self.launch('check', 'a.launch.py')
        self.assertEqual(result.returncode, 1)
        self.assertIn('a.launch.py:2:1: error: Python ends the program here, with exit code 0', result.stdout)

    def test_a_signal_from_outside_ends_the_command_itself(self):
        self.write('import os, signal\nprint("here", flush=True)\nwhile True:\n    signal.pause()\n')
        with subprocess.Popen([LAUNCH, 'check', 'a.launch.py'], cwd=self.directory, stderr=subprocess.PIPE) as command:
            self.assertEqual(command.stderr.readline(), b'here\n')
            command.terminate()
            self.assertEqual(command.wait(), -15)
            self.assertEqual(command.stderr.read(), b'')  # ends when the guest has ended, too


if __name__ == '__main__':
    unittest.main()
