# SPDX-License-Identifier: Apache-2.0
"""
Reads the values that launch files give into the few forms that the launcher reads.

A str, a substitution, or a tuple of them (pasted together) is a text; a list is a list of values; bool, int and float
are themselves.
"""

import itertools
import os
from collections.abc import Iterable, Mapping

from launch.substitution import Substitution


class LaunchFileError(Exception):
    """Something in a launch file that can't be right. It is reported without a Python traceback."""

    def __init__(self, message, help_='', place=None):
        super().__init__(message)
        self.help = help_
        self.place = place  # used when nothing of the launch file is being executed
        self.of_element = None  # the place in a file of XML or YAML, which is used instead


class WrongKind(LaunchFileError, TypeError):
    """A value of a kind that is of no use there. ROS 2 raises TypeError, which a launch file may catch."""


# More parts than any text has: an endless iterator must not fill the memory.
_MOST_PARTS = 50_000


def name_of(value):
    return type(value).__name__


def text(value, what):
    """A text: str, path, substitution, or any of these in a list, which are pasted together."""
    if isinstance(value, str):
        return (_checked(value, what),)
    if isinstance(value, Substitution):
        return (value,)
    if isinstance(value, os.PathLike):
        return text(os.fspath(value), what)
    if isinstance(value, Iterable) and not isinstance(value, _NO_LISTS):
        parts = []
        for part in value:
            parts.extend(text(part, what))
            if len(parts) > _MOST_PARTS:
                raise LaunchFileError(f'{what} has more than {_MOST_PARTS} parts')
        return tuple(parts)
    raise WrongKind(f'{what} must be text, a substitution or a list of them, got {name_of(value)}',
                    f"write '{value}'" if isinstance(value, (bool, int, float)) else '')


# What can be iterated over and still is no list of texts; a set has no order.
_NO_LISTS = (Mapping, bytes, bytearray, memoryview, set, frozenset)


def _checked(value, what):
    """A str that can be passed to a program."""
    if '\0' in value:
        raise LaunchFileError(f'{what} holds the character NUL')
    try:
        value.encode()
    except UnicodeEncodeError:
        raise LaunchFileError(f'{what} holds characters that are no Unicode: {value!r}') from None
    return value


def boolean(value, what):
    """True, False, or a text that gives a boolean."""
    return 'true' if value is True else 'false' if value is False else text(value, what)


def number(value, what):
    """A number, or a text that gives a number."""
    return repr(value) if isinstance(value, (int, float)) and not isinstance(value, bool) else text(value, what)


def words(values, what):
    """A list whose items are texts."""
    if isinstance(values, (str, Substitution)) or not isinstance(values, Iterable):
        raise WrongKind(f'{what} must be a list, got {name_of(values)}', f'write [{values!r}]'
                        if isinstance(values, str) else 'put it in [ ]')
    if isinstance(values, _NO_LISTS):
        raise WrongKind(f'{what} must be a list, got {name_of(values)}')
    found = []
    for value in values:
        found.append(text(value, f'an item of {what}'))
        if len(found) > _MOST_PARTS:
            raise LaunchFileError(f'{what} has more than {_MOST_PARTS} items')
    return found


def pairs(values, what):
    """Pairs of texts, from a list of pairs or a mapping's items."""
    if isinstance(values, Mapping) or isinstance(values, str) or not isinstance(values, Iterable):
        raise WrongKind(f'{what} must be a list of pairs, got {name_of(values)}',
                        'add .items()' if isinstance(values, Mapping) else '')
    result = []
    for pair in values:
        if isinstance(pair, (str, Substitution, *_NO_LISTS)) or not isinstance(pair, Iterable) or (
                len(pair := tuple(itertools.islice(pair, 3))) != 2):
            raise WrongKind(f'{what} must be a list of pairs, one of its items is {pair!r}')
        result.append((text(pair[0], f'a name in {what}'), text(pair[1], f'a value in {what}')))
        if len(result) > _MOST_PARTS:
            raise LaunchFileError(f'{what} has more than {_MOST_PARTS} items')
    return result


def literal(value, what):
    if not isinstance(value, str):
        raise WrongKind(f'{what} must be a str, got {name_of(value)}')
    return (_checked(value, what),)


def function(value, what):
    """Something that can be called."""
    if not callable(value):
        raise WrongKind(f'{what} must be callable, got {name_of(value)}')
    return value


def items(values, what, most=_MOST_PARTS):
    """The items of something that can be iterated over, as a list."""
    if isinstance(values, (str, bytes)) or not isinstance(values, Iterable):
        raise WrongKind(f'{what} must be a list, got {name_of(values)}')
    found = list(itertools.islice(values, most + 1))
    if len(found) > most:
        raise LaunchFileError(f'{what} has more than {most} items')
    return found


def mapping(value, what):
    """The items of a mapping. None and empty values have no items."""
    if not value:
        return ()
    if not isinstance(value, Mapping):
        raise WrongKind(f'{what} must be a mapping, got {name_of(value)}')
    return value.items()


def reject(cls, unknown, known, former=None):
    """Raises an error for keyword arguments that the class doesn't have."""
    import difflib
    for name in unknown:
        help_ = (former or {}).get(name, '')
        near = difflib.get_close_matches(name, known, 1)
        if not help_ and near:
            help_ = f"did you mean '{near[0]}'?"
        raise WrongKind(f"{cls.__name__} has no argument '{name}'", help_)
