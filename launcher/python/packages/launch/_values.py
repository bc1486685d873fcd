# SPDX-License-Identifier: Apache-2.0
"""
Reads the values that launch files give into the few forms that the launcher reads.

A str, a substitution, or a tuple of them (pasted together) is a text; a list is a list of values; bool, int and float
are themselves.
"""

import os
from collections.abc import Iterable, Mapping

from launch.substitution import Substitution


class LaunchFileError(Exception):
    """Something in a launch file that can't be right. It is reported without a Python traceback."""

    def __init__(self, message, help_='', place=None):
        super().__init__(message)
        self.help = help_
        self.place = place  # used when nothing of the launch file is being executed


def name_of(value):
    return type(value).__name__


def text(value, what):
    """A text: str, path, substitution, or any of these in a list, which are pasted together."""
    if isinstance(value, (str, Substitution)):
        return (value,)
    if isinstance(value, os.PathLike):
        return (os.fspath(value),)
    if isinstance(value, Iterable) and not isinstance(value, (Mapping, bytes)):
        parts = []
        for part in value:
            parts.extend(text(part, what))
        return tuple(parts)
    raise LaunchFileError(f'{what} must be text, a substitution or a list of them, got {name_of(value)}',
                          f"write '{value}'" if isinstance(value, (bool, int, float)) else '')


def boolean(value, what):
    """True, False, or a text that gives a boolean."""
    return 'true' if value is True else 'false' if value is False else text(value, what)


def number(value, what):
    """A number, or a text that gives a number."""
    return repr(value) if isinstance(value, (int, float)) and not isinstance(value, bool) else text(value, what)


def words(values, what):
    """A list whose items are texts."""
    if isinstance(values, (str, Substitution)) or not isinstance(values, Iterable):
        raise LaunchFileError(f'{what} must be a list, got {name_of(values)}', f'write [{values!r}]'
                              if isinstance(values, str) else 'put it in [ ]')
    return [text(value, f'an item of {what}') for value in values]


def pairs(values, what):
    """Pairs of texts, from a list of pairs or a mapping's items."""
    if isinstance(values, Mapping) or isinstance(values, str) or not isinstance(values, Iterable):
        raise LaunchFileError(f'{what} must be a list of pairs, got {name_of(values)}',
                              'add .items()' if isinstance(values, Mapping) else '')
    result = []
    for pair in values:
        if isinstance(pair, str) or not isinstance(pair, Iterable) or len(pair := tuple(pair)) != 2:
            raise LaunchFileError(f'{what} must be a list of pairs, one of its items is {pair!r}')
        result.append((text(pair[0], f'a name in {what}'), text(pair[1], f'a value in {what}')))
    return result


def literal(value, what):
    if not isinstance(value, str):
        raise LaunchFileError(f'{what} must be a str, got {name_of(value)}')
    return (value,)


def reject(cls, unknown, known, former=None):
    """Raises an error for keyword arguments that the class doesn't have."""
    import difflib
    for name in unknown:
        help_ = (former or {}).get(name, '')
        near = difflib.get_close_matches(name, known, 1)
        if not help_ and near:
            help_ = f"did you mean '{near[0]}'?"
        raise LaunchFileError(f"{cls.__name__} has no argument '{name}'", help_)
