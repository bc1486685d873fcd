# SPDX-License-Identifier: Apache-2.0
"""
Commands find a running launch by its file: the name, a path from here, an absolute one. LAUNCH_PROGRAM is the launcher.
"""

import os
import pathlib
import signal
import subprocess
import tempfile
import unittest

LAUNCH = os.environ['LAUNCH_PROGRAM']
FILE = '<launch>\n  <executable cmd="sleep {}" name="{}"/>\n</launch>\n'


class LaunchByPath(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.directory = pathlib.Path(directory.name).resolve()
        self.environment = {**os.environ, 'ROS_LOG_DIR': str(self.directory / 'log'), 'XDG_RUNTIME_DIR': str(self.directory / 'run')}
        (self.directory / 'run').mkdir(mode=0o700)
        for name in ('one', 'two'):
            (self.directory / name).mkdir()
            (self.directory / name / 'robot.launch.xml').write_text(FILE.format(1000, name))
            self.start(name)

    def start(self, name):
        """Given by a relative path, from another directory than that of the commands below."""
        process = subprocess.Popen([LAUNCH, 'robot.launch.xml'], cwd=self.directory / name, env=self.environment, stdout=subprocess.PIPE, text=True)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.send_signal, signal.SIGINT)
        while 'process started with pid' not in process.stdout.readline():
            pass

    def ask(self, *words, directory='.'):
        return subprocess.run([LAUNCH, *words], cwd=self.directory / directory, env=self.environment, capture_output=True, text=True, check=False)

    def test_a_path_names_one_of_two_launches(self):
        for path, directory in ((str(self.directory / 'two/robot.launch.xml'), '.'), ('two/robot.launch.xml', '.'), ('./robot.launch.xml', 'two'),
                                ('../two/robot.launch.xml', 'one')):
            with self.subTest(path=path):
                result = self.ask('reload', path, '--dry-run', directory=directory)
                self.assertEqual((result.stdout, result.stderr, result.returncode), ('= 1 process goes on\n', '', 0))
                self.assertIn('two', self.ask('ps', '--launch', path, directory=directory).stdout)

    def test_the_name_alone_names_both(self):
        result = self.ask('reload', 'robot.launch.xml', '--dry-run')
        self.assertIn("several launches have the file 'robot.launch.xml':\n", result.stderr)
        self.assertEqual(result.returncode, 1)

    def test_a_file_that_no_launch_has(self):
        result = self.ask('reload', 'three/robot.launch.xml')
        self.assertIn("launch 'three/robot.launch.xml' does not run; there are:\n", result.stderr)

    def test_the_launch_reads_the_file_again_from_where_it_was_started(self):
        (self.directory / 'two/robot.launch.xml').write_text(FILE.format(1001, 'two'))
        result = self.ask('reload', 'two/robot.launch.xml', '--dry-run')
        self.assertIn('~ two-1', result.stdout)
        self.assertIn('restarts  two/robot.launch.xml:2\n', result.stdout)


if __name__ == '__main__':
    unittest.main()
