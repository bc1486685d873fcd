# SPDX-License-Identifier: Apache-2.0
"""The arguments that a class of the launcher takes from an element: what parse() of a derived class begins with."""

import shlex
from typing import List

from launch._values import LaunchFileError
from launch.frontend._parser import Entity
from launch.utilities.type_utils import coerce_to_type

# argument: (attribute, type). str stands for a text with substitutions, 'words' for a command line.
_OF_PROCESS = {'cwd': ('cwd', str), 'prefix': ('launch-prefix', str), 'output': ('output', str),
               'respawn': ('respawn', str), 'respawn_delay': ('respawn_delay', float),
               'respawn_max_retries': ('respawn_max_retries', int), 'shell': ('shell', bool),
               'emulate_tty': ('emulate_tty', bool), 'sigterm_timeout': ('sigterm_timeout', float),
               'sigkill_timeout': ('sigkill_timeout', float)}
_ATTRIBUTES = {
    'ExecuteLocal': {**_OF_PROCESS, 'cmd': ('cmd', 'words'), 'name': ('name', str)},
    'Node': {**_OF_PROCESS, 'package': ('pkg', str), 'executable': ('exec', str), 'name': ('name', str),
             'namespace': ('namespace', str), 'exec_name': ('exec_name', str), 'arguments': ('args', 'words'),
             'ros_arguments': ('ros_args', 'words')},
    'GroupAction': {'scoped': ('scoped', bool), 'forwarding': ('forwarding', bool)},
    'IncludeLaunchDescription': {'launch_description_source': ('file', str)},
    'TimerAction': {'period': ('period', str), 'cancel_on_shutdown': ('cancel_on_shutdown', str)},
    'SetLaunchConfiguration': {'name': ('name', str), 'value': ('value', str)},
    'UnsetLaunchConfiguration': {'name': ('name', str)},
    'SetEnvironmentVariable': {'name': ('name', str), 'value': ('value', str)},
    'UnsetEnvironmentVariable': {'name': ('name', str)},
    'LogInfo': {'msg': ('message', str)},
    'Shutdown': {'reason': ('reason', str)},
    'PushROSNamespace': {'namespace': ('namespace', str)},
    'SetParameter': {'name': ('name', str), 'value': ('value', str)},
    'SetRemap': {'src': ('from', str), 'dst': ('to', str)},
}


def arguments_of(cls, entity, parser, ignore=()):
    """The arguments, without those of the attributes in `ignore`."""
    names = [base.__name__ for base in cls.__mro__]
    name = next((name for name in names if name in _ATTRIBUTES or name == 'Action'), 'Action')
    own = next(base.__name__ for base in cls.__mro__ if base.__module__.partition('.')[0] in ('launch', 'launch_ros'))
    if name == 'Action' and own != 'Action':
        raise LaunchFileError(f'{own}.parse() is not supported: take the attributes with entity.get_attr()')
    found = _conditions(entity, parser)
    for argument, (attribute, kind) in _ATTRIBUTES.get(name, {}).items():
        if attribute not in ignore:
            value = _value(entity, parser, attribute, kind)
            if value is not None:
                found[argument] = value
    found.update(_children(name, entity, parser, ignore))
    return found


def _conditions(entity, parser):
    from launch.conditions import IfCondition, UnlessCondition
    given = {kind: entity.get_attr(name, optional=True) for name, kind in (('if', IfCondition),
                                                                          ('unless', UnlessCondition))}
    given = {kind: value for kind, value in given.items() if value is not None}
    if len(given) == 2:
        raise LaunchFileError("if and unless conditions can't be used simultaneously")
    return {'condition': kind(parser.parse_substitution(value)) for kind, value in given.items()}


def _value(entity, parser, attribute, kind):
    value = entity.get_attr(attribute, data_type=str if kind == 'words' else kind, optional=True)
    if value is None or kind is bool:
        return value
    if kind == 'words':
        return words(value, parser)
    return parser.parse_substitution(value if isinstance(value, str) else str(value))


def words(command, parser):
    """The words of a command line; what a $(…) gives is not split."""
    pieces, calls = _without_calls(command)
    try:
        split = shlex.split(pieces)
    except ValueError as error:
        raise LaunchFileError(f'{error} in {command!r}') from None
    return [parser.parse_substitution(_with_calls(word, calls)) for word in split]


# Characters that no command line holds.
_FIRST = 0xE000


def _without_calls(command):
    pieces, calls, position = '', [], 0
    while (begin := command.find('$(', position)) != -1:
        end, depth = begin + 2, 1
        while end < len(command) and depth:
            depth += {'(': 1, ')': -1}.get(command[end], 0)
            end += 1
        pieces += command[position:begin] + chr(_FIRST + len(calls))
        calls.append(command[begin:end])
        position = end
    return pieces + command[position:], calls


def _with_calls(word, calls):
    return ''.join(calls[ord(character) - _FIRST] if 0 <= ord(character) - _FIRST < len(calls) else character
                   for character in word)


def _items(entity, name):
    return entity.get_attr(name, data_type=List[Entity], optional=True) or []


def _pairs(entity, parser, tag, first, second):
    return [(parser.parse_substitution(item.get_attr(first)), parser.parse_substitution(item.get_attr(second)))
            for item in _items(entity, tag)]


def _children(name, entity, parser, ignore):
    found = {}
    if name in ('ExecuteLocal', 'Node'):
        if 'env' not in ignore and (pairs := _pairs(entity, parser, 'env', 'name', 'value')):
            found['additional_env'] = {tuple(variable): value for variable, value in pairs}
        if 'on_exit' not in ignore and entity.get_attr('on_exit', optional=True) is not None:
            from launch.actions import Shutdown
            found['on_exit'] = [Shutdown()]
    if name == 'Node':
        if remaps := _pairs(entity, parser, 'remap', 'from', 'to'):
            found['remappings'] = remaps
        if parameters := [_parameter(item, parser) for item in _items(entity, 'param')]:
            found['parameters'] = parameters
    if name == 'IncludeLaunchDescription' and (pairs := _pairs(entity, parser, 'arg', 'name', 'value')):
        found['launch_arguments'] = pairs
    if name == 'GroupAction' and (pairs := _pairs(entity, parser, 'keep', 'name', 'value')):
        found['launch_configurations'] = {tuple(key): value for key, value in pairs}
    if name in ('GroupAction', 'TimerAction') and 'children' not in ignore:
        found['actions'] = [parser.parse_action(child) for child in entity.children if child.type_name != 'keep']
    return found


def _parameter(item, parser):
    path = item.get_attr('from', optional=True)
    if path is not None:
        from launch_ros.parameter_descriptions import ParameterFile
        return ParameterFile(parser.parse_substitution(path),
                             allow_substs=bool(item.get_attr('allow_substs', data_type=bool, optional=True)))
    name = tuple(parser.parse_substitution(item.get_attr('name')))
    nested = _items(item, 'param')
    if nested:
        return {name: {key: value for inner in nested for key, value in _parameter(inner, parser).items()}}
    value = item.get_attr('value', data_type=None)
    if isinstance(value, str):
        value = parser.parse_substitution(value) if '$(' in value else coerce_to_type(value, can_be_str=True)
    return {name: value}
