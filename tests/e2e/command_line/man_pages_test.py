# SPDX-License-Identifier: Apache-2.0
"""Every command has a help, and a man page with what its help says. MAN_PAGES is the folder of the pages."""

import os
import re
import subprocess
import unittest
from pathlib import Path

LAUNCH = os.environ['LAUNCH_PROGRAM']
PAGES = Path(os.environ['MAN_PAGES'])


def help_of(*words):
    return subprocess.run([LAUNCH, *words, '--help'], capture_output=True, text=True, check=True).stdout


class ManPages(unittest.TestCase):
    def test_every_command_has_a_page_with_its_options(self):
        commands = [[name] for name in re.findall(r'^  launch ([a-z]+) .* {2}', help_of(), re.M)]
        for command in [[], *commands, ['trace', 'read']]:
            with self.subTest(command=command):
                text = help_of(*command)
                page = (PAGES / f'{"-".join(["launch", *command])}.1').read_text().replace('\\-', '-')
                for heading in ('NAME', 'SYNOPSIS', 'DESCRIPTION', 'OPTIONS', 'SEE ALSO'):
                    self.assertIn(f'\n.SH {heading}\n', page)
                options = re.findall(r'^  (?:-\w,)?(--[\w-]+)', text, re.M)
                self.assertIn('--help', options)
                self.assertEqual([option for option in options if option not in page], [])

    def test_every_command_that_the_launcher_lists_has_a_page_and_no_other(self):
        listed = subprocess.run([LAUNCH, 'list-commands'], capture_output=True, text=True, check=True).stdout
        names = ['-'.join(['launch', *line.partition('\t')[0].split()]) for line in listed.splitlines()]
        self.assertEqual(names[0], 'launch')
        self.assertIn('launch-trace-read', names)
        self.assertEqual(sorted(names), sorted(path.stem for path in PAGES.glob('*.1')))

    def test_a_page_describes_the_verbs_of_its_command_with_their_options(self):
        pages_with_verbs = set()
        for command in re.findall(r'^  launch ([a-z]+) .* {2}', help_of(), re.M):
            page = (PAGES / f'launch-{command}.1').read_text().replace('\\-', '-')
            for verb in re.findall(r'^  (\w+) ', help_of(command).partition('Subcommands:\n')[2], re.M):
                if (command, verb) == ('trace', 'read'):
                    continue  # has a page of its own
                pages_with_verbs.add(command)
                with self.subTest(command=command, verb=verb):
                    self.assertIn(f'\n.SH {verb.upper()}\n', page)
                    part = page.partition(f'\n.SH {verb.upper()}\n')[2].partition('\n.SH ')[0]
                    options = re.findall(r'^  (?:-\w,)?(--[\w-]+)', help_of(command, verb), re.M)
                    self.assertIn('--help', options)
                    self.assertEqual([option for option in options if option not in part], [])
        self.assertEqual(pages_with_verbs, {'action', 'component', 'interface', 'lifecycle', 'node', 'param', 'service',
                                            'topic', 'trace'})

    def test_the_page_of_trace_describes_its_verbs(self):
        page = (PAGES / 'launch-trace.1').read_text().replace('\\-', '-')
        for part in ('.SH START\n', '.SH RECORD_SNAPSHOT\n', '--snapshot-mode'):
            self.assertIn(part, page)


if __name__ == '__main__':
    unittest.main()
