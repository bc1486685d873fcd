#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""
Writes the man pages from what `launch … --help` prints: write_man_pages.py LAUNCH DIRECTORY

The help is the only description of commands and options. `launch list-commands` tells which commands there are, and their
exit codes. This file adds what no help has: environment, signals.
"""

import re
import subprocess
import sys
from pathlib import Path

MORE = {'launch': [
    ('ENVIRONMENT', [
        ('AMENT_PREFIX_PATH', 'Where packages are searched for, besides the prefix in which launch is installed.'),
        ('ROS_LOG_DIR, ROS_HOME', 'Where log directories are created.'),
        ('ROS_TRACE_DIR', 'Where traces are written. Default: ROS_HOME/tracing.'),
        ('OVERRIDE_LAUNCH_IGNORE_FAILURES', '1: as --ignore-failures.'),
        ('OVERRIDE_LAUNCH_PROCESS_OUTPUT', 'Replaces the attribute "output" of every process.'),
        ('OVERRIDE_LAUNCH_SCREEN_FORMAT, OVERRIDE_LAUNCH_LOG_FORMAT',
         'Formats of the messages of launch on the screen and in its log, such as "{created:.3f} [{levelname}] {name}: '
         '{msg}", or the word default_with_timestamp.'),
        ('OVERRIDE_LAUNCH_KEEP_LOGS', 'Which logs of earlier launches are kept, as --keep-logs.'),
        ('OVERRIDE_LAUNCH_LOG_FILE_NAME', 'The name of the log file. Default: launch.log.'),
        ('NO_COLOR', 'If it is not empty, output has no colours.'),
        ('RCUTILS_COLORIZED_OUTPUT', '0 or 1: output has no colours, or always has.'),
        ('PYTHONPATH', 'Where modules that Python launch files import are searched for, and packages that add actions.')]),
    ('SIGNALS', [
        ('SIGINT, SIGTERM, SIGHUP, SIGQUIT',
         'Shut the system down: every process gets SIGINT, then SIGTERM, then SIGKILL. A second signal sends SIGTERM at '
         'once, a third one SIGKILL. The trace is closed in every case. With --reload-on-hup, SIGHUP reads the launch file '
         'again instead.')])]}

for name in ('events', 'loglevel', 'logs', 'ps', 'restart', 'shutdown', 'signal', 'start', 'stop', 'top'):
    MORE[f'launch {name}'] = [('ENVIRONMENT', [('LAUNCH_ON', 'The default of --on.')])]


def help_of(launch, command):
    words = command.split()[1:]
    return subprocess.run([launch, *words, '--help'], capture_output=True, text=True, check=True).stdout


def escaped(text):
    text = text.replace('\\', '\\e').replace('-', '\\-')
    return '\\&' + text if text.startswith(('.', "'")) else text


COLUMN = 30  # where the help of an entry begins, in bytes, unless the names reach so far


def entry(line):
    """(names, help); the help may be in the next line."""
    whole = line.encode()
    if whole[COLUMN - 1:COLUMN] != b' ':
        return line.strip(), ''
    return whole[:COLUMN].decode().strip(), whole[COLUMN:].decode().strip()


class Help:
    """The parts of a help text: description, usage, sections of entries, and the lines after them."""

    def __init__(self, text):
        before, _, after = text.partition('Usage: ')
        self.description = ' '.join(before.split())
        self.usage, _, rest = after.partition('\n')
        self.sections = []  # (heading, [(names, help)])
        self.footer = []
        for line in rest.splitlines():
            if line in ('Positionals:', 'Options:', 'Subcommands:'):
                self.sections.append((line[:-1], []))
            elif re.match(r'  \S', line) and self.sections and not self.footer:
                self.sections[-1][1].append(entry(line))
            elif re.match(r' {20,}\S', line) and self.sections and not self.footer:
                names, text = self.sections[-1][1].pop()
                self.sections[-1][1].append((names, f'{text} {line.strip()}'.strip()))
            elif line.strip() or self.footer:
                self.footer.append(line)

    def section(self, heading):
        return next((entries for name, entries in self.sections if name == heading), [])


def entries_text(entries):
    return ''.join(f'.TP\n.B {escaped(names)}\n{escaped(text)}\n' for names, text in entries if text)


def page(command, status, help_, others, verbs):
    name = command.replace(' ', '-')
    summary = re.split(r'[.:](?: |$)', help_.description)[0]
    text = f'.TH {name.upper()} 1 "" "launch" "User commands"\n'
    text += f'.SH NAME\n{escaped(name)} \\- {escaped(summary[0].lower() + summary[1:])}\n'
    text += f'.SH SYNOPSIS\n.B {escaped(help_.usage)}\n'
    text += f'.SH DESCRIPTION\n{escaped(help_.description)}\n'
    if help_.section('Positionals'):
        text += '.SH ARGUMENTS\n' + entries_text(help_.section('Positionals'))
    text += '.SH OPTIONS\n' + entries_text(help_.section('Options'))
    for verb, of_verb in verbs:
        text += f'.SH {escaped(verb.upper())}\n.B {escaped(of_verb.usage)}\n.PP\n{escaped(of_verb.description)}\n'
        text += entries_text(of_verb.section('Positionals') + of_verb.section('Options'))
    if help_.footer:
        text += '.SH NOTES\n.nf\n' + ''.join(f'{escaped(line)}\n' for line in help_.footer) + '.fi\n'
    for heading, entries in MORE.get(command, []):
        text += f'.SH {heading}\n' + entries_text(entries)
    if status:
        text += f'.SH EXIT STATUS\n{escaped(status)}\n'
    return text + '.SH SEE ALSO\n' + ',\n'.join(f'.BR {escaped(other.replace(" ", "-"))} (1)' for other in others) + '\n'


def main(launch, directory):
    listed = subprocess.run([launch, 'list-commands'], capture_output=True, text=True, check=True).stdout
    rows = (line.split('\t') for line in listed.splitlines())
    commands = {f'launch {name}'.strip(): status for name, status in rows}
    for command, status in commands.items():
        help_ = Help(help_of(launch, command))
        verbs = [(verb, Help(help_of(launch, f'{command} {verb}'))) for verb, _ in help_.section('Subcommands')
                 if f'{command} {verb}' not in commands]
        others = [other for other in commands if other != command]
        (Path(directory) / f'{command.replace(" ", "-")}.1').write_text(page(command, status, help_, others, verbs))


if __name__ == '__main__':
    main(*sys.argv[1:])
