# SPDX-License-Identifier: Apache-2.0
"""A mistake in a command line is told in one form by every command and verb, with exit code 2."""

import os
import pathlib
import re
import subprocess
import tempfile
import unittest

LAUNCH = os.environ['LAUNCH_PROGRAM']


def launch(*words):
    return subprocess.run([LAUNCH, *words], capture_output=True, text=True, timeout=60, stdin=subprocess.DEVNULL, check=False)


class CommandErrors(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.commands = re.findall(r'^  launch ([a-z]+) .* {2}', launch('--help').stdout, re.M)
        cls.verbs = [(command, verb) for command in cls.commands for verb in re.findall(
            r'^  (\w+) ', launch(command, '--help').stdout.partition('Subcommands:\n')[2], re.M)]

    def test_an_unknown_option(self):
        for words in [(), *((command,) for command in self.commands), *self.verbs]:
            with self.subTest(words):
                name = ' '.join(['launch', *words])
                result = launch(*words, '--hepl')
                self.assertEqual(result.returncode, 2)
                self.assertEqual(result.stdout, '')
                self.assertEqual(result.stderr, f"{name}: error: unknown option '--hepl'\n"
                                                "      = help: did you mean '--help'?\n"
                                                f"      = help: see '{name} --help'\n")

    def test_an_unknown_verb(self):
        for command in {command for command, _ in self.verbs}:
            with self.subTest(command):
                result = launch(command, 'frobnicate')
                self.assertEqual(result.returncode, 2)
                self.assertEqual(result.stderr, f"launch {command}: error: unknown command 'frobnicate'\n"
                                                f"      = help: see 'launch {command} --help'\n")
        for command, verb, typed in (('topic', 'echo', 'ehco'), ('node', 'info', 'ifno'), ('param', 'dump', 'dmup'),
                                     ('lifecycle', 'nodes', 'node'), ('trace', 'start', 'strat')):
            self.assertEqual(launch(command, typed, '/x').stderr.splitlines()[1], f"      = help: did you mean '{verb}'?")

    def test_a_value_that_is_none_of_a_list(self):
        for words, message, meant in (
                (('check', '--format', 'jsn', 'x'), '--format jsn is unknown, expected text, json, sarif, github, gitlab', 'json'),
                (('graph', '--format', 'sgv', 'x'), '--format sgv is unknown, expected dot, svg', 'svg'),
                (('schema', 'dryrun'), 'format dryrun is unknown, expected xsd, json, dry-run', 'dry-run'),
                (('report', '--sort', 'nme', 'x'), None, 'name')):
            with self.subTest(words):
                result = launch(*words)
                self.assertEqual(result.returncode, 2)
                if message is not None:
                    self.assertEqual(result.stderr.splitlines()[0], f'launch {words[0]}: error: {message}')
                self.assertIn(f"\n      = help: did you mean '{meant}'?\n", result.stderr)

    def test_a_value_that_is_missing(self):
        for words, message in ((('check',), 'no launch file given'), (('graph',), 'no launch file given'),
                               (('test',), 'no launch file given'), (('stop',), 'NAME is required'),
                               (('run', 'demo_nodes'), 'no program given'), (('report',), 'directory is required'),
                               (('trace', 'read'), 'directory is required'),
                               (('trace', 'start'), 'session_name is required'),
                               (('signal', 'x'), 'NAME and SIGNAL are required'),
                               (('build', '--jobs'), '--jobs needs a value')):
            with self.subTest(words):
                name = ' '.join(['launch', words[0], *(words[1:] if words[0] == 'trace' else [])])
                result = launch(*words)
                self.assertEqual(result.returncode, 2)
                self.assertEqual(result.stderr.splitlines()[0], f'{name}: error: {message}')
                self.assertEqual(result.stderr.splitlines()[-1], f"      = help: see '{name} --help'")

    def test_a_result_that_can_not_be_written(self):
        for words in (('schema',), ('schema', 'dry-run'), ('reference',), ('explain',), ('interface', 'list')):
            with self.subTest(words), open('/dev/full', 'wb') as full:
                result = subprocess.run([LAUNCH, *words], stdout=full, stderr=subprocess.PIPE, text=True, timeout=60, check=False)
                self.assertEqual(result.returncode, 1)
                self.assertTrue(result.stderr.startswith(f'launch {words[0]}'), result.stderr)
                self.assertIn(": error: ", result.stderr)

    def test_help_is_no_error(self):
        for words in [(), *((command,) for command in self.commands), *self.verbs]:
            for option in ('-h', '--help'):
                result = launch(*words, option)
                self.assertEqual((words, result.returncode, result.stderr), (words, 0, ''))
                self.assertIn(f'Usage: {" ".join(["launch", *words])}', result.stdout)


    def test_a_launch_file_whose_ending_is_mistyped_is_suggested(self):
        with tempfile.TemporaryDirectory() as directory:
            for name in ('a.launch.py', 'a.launch.xml', 'b.launch.xml'):
                (pathlib.Path(directory) / name).write_text('<launch/>')
            for typed, meant in (('a.lauch.xml', 'a.launch.xml'), ('a.launch.yp', 'a.launch.py'), ('a.launchxml', 'a.launch.xml')):
                result = subprocess.run([LAUNCH, 'check', typed], cwd=directory, capture_output=True, text=True, check=False)
                self.assertEqual(result.stdout, f"error: launch file '{typed}' does not exist [LF0001]\n"
                                                f"      = help: did you mean '{meant}'?\n0 files: 1 error, 0 warnings\n")

    def test_a_file_without_an_end_is_an_error(self):
        result = launch('check', '/dev/zero')
        self.assertEqual(result.stdout, "error: '/dev/zero' is larger than 64 MiB [LF0001]\n"
                                        '      = help: no launch file is so large; is it another file?\n'
                                        '1 file: 1 error, 0 warnings\n')


if __name__ == '__main__':
    unittest.main()
