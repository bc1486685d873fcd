# SPDX-License-Identifier: Apache-2.0
"""Texts with $(…) in them, as XML and YAML files write them."""

from launch._values import literal
from launch.substitutions import Substitution, TextSubstitution


class _Parsed(Substitution):
    """A text whose $(…) the launcher reads as in an XML file."""

    def __init__(self, template):
        self._template = literal(template, 'a substitution')

    def _part(self):
        return ('parsed', [self._template])

    def perform(self, context):
        return context._perform(self)

    def describe(self):
        return self._template[0]


def replace_escaped_characters(data):
    """A backslash and a character become this character."""
    import re
    return re.sub(r'\\(.)', r'\1', data)


def parse_substitution(string_value):
    """A list of substitutions whose texts are pasted together."""
    if '$(' not in string_value and '\\' not in string_value:
        return [TextSubstitution(text=string_value)]
    return [_Parsed(string_value)]


def parse_if_substitutions(value):
    """The value, with substitutions where it holds $(…) in its texts."""
    if isinstance(value, str):
        found = parse_substitution(value)
        return value if type(found[0]) is TextSubstitution else found
    return [parse_if_substitutions(item) for item in value] if isinstance(value, list) else value
