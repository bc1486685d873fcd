# SPDX-License-Identifier: Apache-2.0
"""What is known of a process that a test looks at."""


class ForeignProcess:
    """A process of an XML or YAML file, which no action of Python stands for."""

    def __init__(self, name):
        self.process_details = {'name': name, 'cmd': [name]}

    @property
    def name(self):
        return self.process_details['name']


def name_and_arguments(process):
    details = process.process_details
    if not details:
        return 'Unknown - Process not launched yet'
    return ' '.join([details['name'], *map(str, details['cmd'][1:])])


def command_line(pid):
    """The words of the command line of a running process; None when it has ended."""
    try:
        with open(f'/proc/{pid}/cmdline', encoding='utf-8', errors='surrogateescape') as file:
            return file.read().split('\0')[:-1] or None
    except OSError:
        return None
