# SPDX-License-Identifier: Apache-2.0
"""What the launcher reads, as JSON (launcher/python/script/script_values.hpp is the other side)."""

import itertools
import math

from launch._values import LaunchFileError

_DEEPEST = 200  # objects that hold each other more deeply would exhaust the launcher's stack
_LARGEST = 1 << 63


class Objects:
    """The objects that the launcher can call, by their numbers."""

    def __init__(self):
        self._numbers = itertools.count(1)
        self._objects = {}

    def number(self, obj):
        number = next(self._numbers)
        self._objects[number] = obj
        return number

    def __getitem__(self, number):
        return self._objects[number]

    def drop(self, numbers):
        for number in numbers:
            self._objects.pop(number, None)


def _str(value):
    if '\0' in value:
        raise LaunchFileError(f'a text holds the character NUL: {value!r}')
    try:
        value.encode()
    except UnicodeEncodeError:
        raise LaunchFileError(f'a text holds characters that are no Unicode: {value!r}') from None
    return value


def _part(value, objects, depth):
    if isinstance(value, str):
        return _str(value)
    part = {'place': value._place()}
    call = value._part()
    if call is None:
        part['object'] = objects.number(value)
    elif isinstance(call, str):
        part['text'] = _str(call)
    else:
        part['call'] = call[0]
        part['arguments'] = [text(argument, objects, depth) for argument in call[1]]
    return part


def _deeper(depth):
    if depth >= _DEEPEST:
        raise LaunchFileError(f'objects of the launch file hold each other more than {_DEEPEST} deep')
    return depth + 1


def text(value, objects, depth=0):
    """The parts of a text: a str, a substitution, or a tuple of them."""
    depth = _deeper(depth)
    return [_part(part, objects, depth) for part in (value if isinstance(value, tuple) else (value,))]


def _value(value, objects, depth):
    depth = _deeper(depth)
    if isinstance(value, bool):
        return value
    if isinstance(value, int):
        if not -_LARGEST <= value < _LARGEST:
            raise LaunchFileError(f'a number has more than 64 bits: {value}')
        return int(value)
    if isinstance(value, float):
        return float(value) if math.isfinite(value) else {'float': str(float(value))}
    if isinstance(value, list):
        return [_value(item, objects, depth) for item in value]
    return {'text': text(value, objects, depth)}


def entities(given, objects, depth=0):
    return [_entity(entity, objects, depth) for entity in given]


def _entity(entity, objects, depth):
    depth = _deeper(depth)
    tag, place, attributes, children, obj, process_name = entity
    try:
        return [tag, place,
                [[name, _value(value, objects, depth), of_value[0] if of_value else None]
                 for name, value, *of_value in attributes],
                entities(children, objects, depth), None if obj is None else objects.number(obj), process_name]
    except LaunchFileError as error:
        error.place = error.place or place
        raise


def element(given):
    """An element of an XML or YAML file as launch.frontend reads it, of the lists that JSON has."""
    tag, place, attributes, children, number, is_item = given
    return (tag, tuple(place), [(name, value, tuple(of_value), tuple(of_name), untyped)
                                for name, value, of_value, of_name, untyped in attributes],
            [element(child) for child in children], number, is_item)
