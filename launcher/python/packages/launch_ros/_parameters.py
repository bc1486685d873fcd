# SPDX-License-Identifier: Apache-2.0
"""Reads the `parameters` of nodes: files, mappings, and the two kinds of descriptions."""

import os
from collections.abc import Mapping, Sequence

from launch._entities import entity
from launch._values import LaunchFileError, WrongKind, boolean, name_of, text
from launch.substitution import Substitution
from launch.substitutions import _Builtin
from launch.utilities.type_utils import is_text
from launch_ros.parameter_descriptions import Parameter, ParameterFile, ParameterValue

_SCALARS = (bool, int, float)


class _TypedText(_Builtin):
    """A text whose type is found when it is performed, even if it holds no substitution."""

    _call = 'string-join'

    def __init__(self, value):
        self._take('', value)


def parameter_items(parameters, place):
    """The <param> items of a node."""
    if parameters is None:
        return []
    if isinstance(parameters, (str, bytes)) or not isinstance(parameters, Sequence):
        raise WrongKind(f'parameters must be a list, got {name_of(parameters)}', 'put it in [ ]')
    items = []
    for given in parameters:
        if isinstance(given, Mapping):
            items.append(entity('param', place, [('name', '')], [_item(name, value, place)
                                                                 for name, value in given.items()]) if given else None)
        elif isinstance(given, Parameter):
            items.append(_item(given._name, given._value, given._place()))
        elif isinstance(given, ParameterFile):
            allowed = [('allow_substs', boolean(given._allow_substs, 'allow_substs'))] if given._allow_substs else []
            items.append(entity('param', given._place(), [('from', given._path), *allowed]))
        elif isinstance(given, (str, Substitution, os.PathLike)) or (
                isinstance(given, Sequence) and not isinstance(given, bytes)):
            items.append(entity('param', place, [('from', text(given, 'a parameter file'))]))
        else:
            raise WrongKind(f'parameters can hold files and mappings, got {name_of(given)}')
    return [item for item in items if item is not None]


def _item(name, value, place):
    name = text(name, 'the name of a parameter')
    if isinstance(value, Mapping):
        return entity('param', place, [('name', name)], [_item(inner, item, place) for inner, item in value.items()])
    type_ = None
    if isinstance(value, ParameterValue):
        place, type_, value = value._place(), value._type, value._value
    return entity('param', place, [('name', name), ('value', parameter_value(value)), ('type', type_)])


def parameter_value(value):
    """A scalar, a list of scalars, or a text. A str stays a text; the type of substitutions is found when performed."""
    if isinstance(value, (str, *_SCALARS)):
        return _scalar(value)
    if isinstance(value, (Substitution, os.PathLike)):
        return text(value, 'a parameter')
    if isinstance(value, Sequence) and not isinstance(value, (bytes, bytearray, memoryview)):
        return _list(list(value))
    raise WrongKind(f'a parameter can\'t be a {name_of(value)}',
                    'use a bool, an int, a float, a str, a substitution or a list of them')


def _scalar(value):
    if isinstance(value, int) and not -1 << 63 <= value < 1 << 63:
        raise LaunchFileError(f'a parameter has at most 64 bits, got {value}')
    return text(value, 'a parameter')[0] if isinstance(value, str) else value


def _list(values):
    # A substitution among texts means that all of them are pasted together.
    if any(isinstance(value, Substitution) for value in values):
        return text(values, 'a parameter')
    if any(isinstance(value, float) for value in values) and all(type(value) in (int, float) for value in values):
        return [float(value) for value in values]
    return [_scalar(value) if isinstance(value, (str, *_SCALARS)) else (_TypedText(value),) for value in values]


def as_yaml(value):
    """The text that the rules of YAML read as this value; substitutions stay as they are."""
    if isinstance(value, ParameterValue):
        return _typed_as_yaml(value)
    value = parameter_value(value)
    if isinstance(value, bool):
        return 'true' if value else 'false'
    if isinstance(value, str):
        return "'" + value.replace("'", "''") + "'"
    if isinstance(value, list):
        parts = ['[']
        for item in value:
            parts += [', '] if len(parts) > 1 else []
            parts += text(as_yaml(item) if not isinstance(item, tuple) else item, 'an item')
        return (*parts, ']')
    return repr(value) if isinstance(value, (int, float)) else value


_TAGS = {'bool': '!!bool ', 'int': '!!int ', 'float': '!!float '}


def _typed_as_yaml(value):
    """Of a ParameterValue. Without a type, a text is read by the rules of YAML."""
    if not is_text(value._value):
        return as_yaml(value._value)
    parts = text(value._value, 'a parameter')
    if value._type == 'str':
        return as_yaml(parts[0]) if len(parts) == 1 and isinstance(parts[0], str) else ("'", *parts, "'")
    return (_TAGS[value._type], *parts) if value._type in _TAGS else parts
