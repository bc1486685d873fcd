# SPDX-License-Identifier: Apache-2.0
"""What the shells' completion offers: options of every command, files beside commands, values; and the script for bash."""

import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

LAUNCH = os.environ['LAUNCH_PROGRAM']
BASH_SCRIPT = Path(os.environ['SOURCE_DIRECTORY']) / 'programs/launch/completion/launch.bash'


def launch(*words, **options):
    result = subprocess.run([LAUNCH, *words], capture_output=True, text=True, timeout=60, check=False, **options)
    return result.stdout


def commands():
    return re.findall(r'^  launch ([a-z]+) .* {2}', launch('--help'), re.M)


def verbs(command):
    return re.findall(r'^  (\w+) ', launch(command, '--help').partition('Subcommands:\n')[2], re.M)


def options_in_help(*words):
    return sorted(option for names in re.findall(r'^  ((?:-\w,)*--\S+)', launch(*words, '--help'), re.M)
                  for option in names.partition('{')[0].split(',') if option.startswith('--'))


class Completion(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def complete(self, *words):
        return launch('complete', *words, cwd=self.folder).splitlines()

    def test_every_command_and_verb_offers_the_options_of_its_help(self):
        all_words = [[], *([name] for name in commands()),
                     *([name, verb] for name in commands() for verb in verbs(name))]
        self.assertIn(['topic', 'echo'], all_words)
        self.assertIn(['trace', 'read'], all_words)
        for words in all_words:
            with self.subTest(words=words):
                offered = self.complete(*words, '--')
                self.assertIn('--help', offered)
                self.assertEqual(sorted({*offered} - {'--dry-run=json', '--dry-run=shell'}), options_in_help(*words))

    def test_every_command_is_offered(self):
        self.assertEqual(set(commands()) - set(self.complete('')), set())
        for command in ('topic', 'node', 'service', 'param', 'action', 'lifecycle', 'component', 'interface', 'trace'):
            self.assertEqual(self.complete(command, ''), sorted([*verbs(command)] + ['--help'] * (command != 'trace')))

    def test_launch_files_and_directories_stand_beside_commands(self):
        (self.folder / 'graphics').mkdir()
        (self.folder / 'graphics/arm.launch.py').touch()
        (self.folder / 'grasp.launch.xml').touch()
        (self.folder / 'grasp.txt').touch()
        self.assertEqual(self.complete('gra'), ['graph', 'graphics/', 'grasp.launch.xml'])
        self.assertEqual(self.complete('check', 'gra'), ['graphics/', 'grasp.launch.xml'])
        self.assertEqual(self.complete('graphics/'), ['graphics/arm.launch.py'])

    def test_values_that_the_help_lists(self):
        self.assertEqual(self.complete('graph', '--format', ''), ['dot', 'svg'])
        self.assertEqual(self.complete('check', '--format', 's'), ['sarif'])
        self.assertEqual(self.complete('trace', 'read', '--format', ''), ['csv', 'json', 'text'])
        self.assertEqual(self.complete('schema', ''), ['dry-run', 'json', 'xsd'])
        self.assertIn('LF0101', self.complete('explain', 'LF'))

    def bash(self, line):
        """What bash would show for the line, and whether it would put no space behind it."""
        script = ('compopt() { echo nospace; }; source "$1"; COMP_LINE=$2 COMP_POINT=${#2}; _launch; '
                  'printf "%s\\n" "${COMPREPLY[@]}"')
        result = subprocess.run(['bash', '-c', script, 'bash', str(BASH_SCRIPT), line], capture_output=True, text=True,
                                timeout=60, cwd=self.folder, check=True)
        self.assertEqual(result.stderr, '')
        return result.stdout.split()

    def test_the_script_for_bash(self):
        (self.folder / 'zoo').mkdir()
        (self.folder / 'a.launch.xml').write_text('<launch><arg name="mode" default="a"><choice value="a"/>'
                                                  '<choice value="b"/></arg></launch>\n')
        self.assertEqual(self.bash(f'{LAUNCH} explai'), ['explain'])
        self.assertEqual(self.bash(f'{LAUNCH} zo'), ['nospace', 'zoo/'])
        self.assertEqual(self.bash(f'{LAUNCH} a.launch.xml m'), ['nospace', 'mode:='])
        self.assertEqual(self.bash(f'{LAUNCH} a.launch.xml mode:='), ['a', 'b'])
        self.assertEqual(self.bash(f'{LAUNCH} topic ec'), ['echo'])
        self.assertEqual(self.bash(f'{LAUNCH} report --htm'), ['--html'])
        self.assertEqual(self.bash(f'{LAUNCH} report no_such'), [])


if __name__ == '__main__':
    unittest.main()
