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
        words = [_literal(word) for word in getattr(process, 'cmd', None) or ()]
        return ' '.join(words) if words and None not in words else 'Unknown - Process not launched yet'
    return ' '.join([details['name'], *map(str, details['cmd'][1:])])


def _literal(word):
    """The text of a word of a command; None if only a launch knows it."""
    parts = word if isinstance(word, (list, tuple)) else [word]
    texts = [part if isinstance(part, str) else getattr(part, 'text', None) for part in parts]
    return None if None in texts else ''.join(texts)
