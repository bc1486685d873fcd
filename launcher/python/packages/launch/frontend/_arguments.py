# SPDX-License-Identifier: Apache-2.0
"""The arguments that a class of the launcher takes from an element: what parse() of a derived class begins with."""

import shlex

from launch._values import LaunchFileError
from launch.frontend._parser import Entity

# argument: (attribute, type). str stands for a text with substitutions, 'literal' for one without, 'words' for a command
# line, 'typed' for what the rules of YAML make of the text.
_OF_PROCESS = {'cwd': ('cwd', str), 'prefix': ('launch-prefix', str), 'output': ('output', str),
               'respawn': ('respawn', str), 'respawn_delay': ('respawn_delay', float),
               'respawn_max_retries': ('respawn_max_retries', int), 'shell': ('shell', bool),
               'emulate_tty': ('emulate_tty', bool), 'sigterm_timeout': ('sigterm_timeout', float),
               'sigkill_timeout': ('sigkill_timeout', float)}
_OF_NODE = {**_OF_PROCESS, 'package': ('pkg', str), 'executable': ('exec', str), 'name': ('name', str),
            'namespace': ('namespace', str), 'exec_name': ('exec_name', str), 'arguments': ('args', 'words'),
            'ros_arguments': ('ros_args', 'words')}
_OF_COMPOSABLE = {'package': ('pkg', str), 'plugin': ('plugin', str), 'name': ('name', str), 'namespace': ('namespace', str)}
_MESSAGE = {'msg': ('message', str)}
# In ROS 2 these have no element of their own: parse() takes the condition alone.
_WITHOUT_ELEMENT = ('EmitEvent', 'LifecycleTransition', 'OpaqueCoroutine', 'OpaqueFunction', 'PopEnvironment',
                    'PopLaunchConfigurations', 'PushEnvironment', 'PushLaunchConfigurations', 'RegisterEventHandler',
                    'UnregisterEventHandler')
# The nearest base that is named here tells the attributes.
_ATTRIBUTES = {
    'ExecuteLocal': {**_OF_PROCESS, 'cmd': ('cmd', 'words'), 'name': ('name', str)},
    'Node': _OF_NODE,
    'LifecycleNode': {**_OF_NODE, 'autostart': ('autostart', str)},
    'ComposableNode': _OF_COMPOSABLE,
    'ComposableLifecycleNode': {**_OF_COMPOSABLE, 'autostart': ('autostart', str)},
    'LoadComposableNodes': {'target_container': ('target', str)},
    'DeclareLaunchArgument': {'name': ('name', 'literal'), 'default_value': ('default', str),
                              'description': ('description', str)},
    'GroupAction': {'scoped': ('scoped', bool), 'forwarding': ('forwarding', bool)},
    'IncludeLaunchDescription': {'launch_description_source': ('file', str)},
    'ForLoop': {'length': ('len', str), 'name': ('name', 'literal')},
    'ForEach': {'input_values': ('values', str)},
    'TimerAction': {'period': ('period', float), 'cancel_on_shutdown': ('cancel_on_shutdown', str)},
    'SetLaunchConfiguration': {'name': ('name', str), 'value': ('value', str)},
    'UnsetLaunchConfiguration': {'name': ('name', str)},
    'SetEnvironmentVariable': {'name': ('name', str), 'value': ('value', str)},
    'UnsetEnvironmentVariable': {'name': ('name', str)},
    'ResetLaunchConfigurations': {},
    'AppendEnvironmentVariable': {'name': ('name', str), 'value': ('value', str), 'prepend': ('prepend', str),
                                  'separator': ('separator', str)},
    'ResetEnvironment': {},
    'ReplaceEnvironmentVariables': {},
    'Log': {**_MESSAGE, 'level': ('level', str)},
    'LogDebug': _MESSAGE,
    'LogInfo': _MESSAGE,
    'LogWarning': _MESSAGE,
    'LogError': _MESSAGE,
    'Shutdown': {'reason': ('reason', str)},
    'PushRosNamespace': {'namespace': ('namespace', str)},
    'SetParameter': {'name': ('name', str), 'value': ('value', 'typed')},
    'SetParametersFromFile': {'filename': ('filename', str)},
    'SetUseSimTime': {'value': ('value', str)},
    'SetROSLogDir': {'new_log_dir': ('new_log_dir', str)},
    'SetRemap': {'src': ('from', str), 'dst': ('to', str)},
    'Trace': {'session_name': ('session-name', str), 'append_timestamp': ('append-timestamp', bool),
              'base_path': ('base-path', str), 'append_trace': ('append-trace', bool), 'events_ust': ('events-ust', 'words'),
              'events_kernel': ('events-kernel', 'words'), 'syscalls': ('syscalls', 'words'),
              'context_fields': ('context-fields', 'words'), 'subbuffer_size_ust': ('subbuffer-size-ust', int),
              'subbuffer_size_kernel': ('subbuffer-size-kernel', int), 'snapshot_mode': ('snapshot-mode', bool),
              'dual_session': ('dual-session', bool)},
}


def arguments_of(cls, entity, parser, ignore=()):
    """The arguments, without those of the attributes in `ignore`."""
    names = [base.__name__ for base in cls.__mro__]
    name = next((name for name in names if name in _ATTRIBUTES or name == 'Action'), 'Action')
    own = next(base.__name__ for base in cls.__mro__ if base.__module__.partition('.')[0] in ('launch', 'launch_ros'))
    if name == 'Action' and own not in ('Action', *_WITHOUT_ELEMENT):
        raise LaunchFileError(f'{own}.parse() is not supported: take the attributes with entity.get_attr()')
    found = _conditions(entity, parser)
    for argument, (attribute, kind) in _ATTRIBUTES.get(name, {}).items():
        if attribute not in ignore:
            value = _value(entity, parser, attribute, kind)
            if value is not None:
                found[argument] = value
    found.update(_children(name, names, entity, parser, ignore))
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
    data_type = {'words': str, 'literal': str, 'typed': None}.get(kind, kind)
    value = entity.get_attr(attribute, data_type=data_type, optional=True)
    if value is None or kind in (bool, 'literal'):
        return value
    if kind == 'typed':
        # A text of the launcher's own elements has its type already.
        is_own = getattr(entity, 'place', None) is not None
        return _typed(value, parser) if is_own or not isinstance(value, str) else parser.parse_substitution(value)
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
    return entity.get_attr(name, data_type=list[Entity], optional=True) or []


def _pairs(entity, parser, tag, first, second):
    return [(parser.parse_substitution(item.get_attr(first)), parser.parse_substitution(item.get_attr(second)))
            for item in _items(entity, tag)]


_WITH_ROS_ITEMS = ('Node', 'LifecycleNode', 'ComposableNode', 'ComposableLifecycleNode')


def _children(name, names, entity, parser, ignore):
    found = {}
    if name in ('ExecuteLocal', 'Node', 'LifecycleNode'):
        if 'env' not in ignore and (pairs := _pairs(entity, parser, 'env', 'name', 'value')):
            found['additional_env'] = {tuple(variable): value for variable, value in pairs}
        if 'on_exit' not in ignore and entity.get_attr('on_exit', optional=True) is not None:
            from launch.actions import Shutdown
            found['on_exit'] = [Shutdown()]
    if name in _WITH_ROS_ITEMS:
        if remaps := _pairs(entity, parser, 'remap', 'from', 'to'):
            found['remappings'] = remaps
        if parameters := [_parameter(item, parser) for item in _items(entity, 'param')]:
            found['parameters'] = parameters
    if name == 'IncludeLaunchDescription' and (pairs := [*_pairs(entity, parser, 'arg', 'name', 'value'),
                                                         *_pairs(entity, parser, 'let', 'name', 'value')]):
        found['launch_arguments'] = pairs
    if name in ('ComposableNode', 'ComposableLifecycleNode'):
        if extra := [_parameter(item, parser) for item in _items(entity, 'extra_arg')]:
            found['extra_arguments'] = extra
    if name == 'LoadComposableNodes' or 'ComposableNodeContainer' in names:
        found['composable_node_descriptions'] = _composable_nodes(entity, parser)
    if name == 'DeclareLaunchArgument' and (choices := [item.get_attr('value') for item in _items(entity, 'choice')]):
        found['choices'] = choices
    if name == 'ReplaceEnvironmentVariables' and (pairs := _pairs(entity, parser, 'env', 'name', 'value')):
        found['environment'] = {tuple(variable): value for variable, value in pairs}
    if name in ('GroupAction', 'ResetLaunchConfigurations') and (pairs := _pairs(entity, parser, 'keep', 'name', 'value')):
        found['launch_configurations'] = {tuple(key): value for key, value in pairs}
    if name in ('ForLoop', 'ForEach') and 'function' not in ignore:
        index = str(entity.get_attr('name')) if name == 'ForLoop' else None
        found['function'] = _turns([parser.parse_action(child) for child in entity.children], index,
                                   getattr(entity, 'place', None))
    if name in ('GroupAction', 'TimerAction') and 'children' not in ignore:
        found['actions'] = [parser.parse_action(child) for child in entity.children if child.type_name != 'keep']
    return found


def _turns(children, index, place):
    """What the loop calls for each of its turns: with the index, or with the values of the turn."""
    from launch.actions._groups import _Turn
    if index is not None:
        return lambda i: [_Turn({index: i}, children, place)]
    return lambda **values: [_Turn(values, children, place)]


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
    return {name: _typed(item.get_attr('value', data_type=None), parser)}


def _typed(value, parser):
    return parser.parse_substitution(value) if isinstance(value, str) and '$(' in value else value


def _composable_nodes(entity, parser):
    from launch_ros.descriptions import ComposableLifecycleNode, ComposableNode
    found = []
    for tag, node in (('composable_node', ComposableNode), ('composable_lifecycle_node', ComposableLifecycleNode)):
        for item in _items(entity, tag):
            cls, arguments = node.parse(parser, item)
            found.append(cls(**arguments))
    return found
