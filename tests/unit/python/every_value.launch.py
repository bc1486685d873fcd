# SPDX-License-Identifier: Apache-2.0
"""
Calls every class and function of the launcher's packages with arguments of every wrong kind, and visits what that makes.

Each case is an action of its own, so that `launch check`, which goes on after an error, tries all of them in one
process. The number of each case is written to the file that EVERY_VALUE_PROGRESS names before the case is tried, so
that a case that ends the process is known. EVERY_VALUE_ONLY: the number of one case, with which the description holds
nothing else.
"""

import functools
import importlib
import inspect
import os
import pkgutil

from launch import Action, Condition, LaunchDescription, LaunchDescriptionEntity, Substitution
from launch.actions import EmitEvent, ExecuteProcess, IncludeLaunchDescription, LogInfo, OpaqueFunction
from launch.actions import RegisterEventHandler
from launch.event_handler import BaseEventHandler
from launch.launch_description_source import LaunchDescriptionSource
from launch_ros.actions import LoadComposableNodes, Node
from launch_ros.descriptions import ComposableNode
from launch_ros.parameter_descriptions import Parameter, ParameterFile, ParameterValue

PACKAGES = ('launch', 'launch_ros', 'launch_extensions', 'launch_xml', 'launch_yaml', 'lifecycle_msgs',
            'ament_index_python', 'tracetools_launch', 'tracetools_trace')


class Endless:
    """Holds itself."""

    def __iter__(self):
        while True:
            yield 'x'


class Unwilling:
    """Fails at whatever is asked of it."""

    def __getattr__(self, name):
        raise RuntimeError(name)

    def __str__(self):
        raise RuntimeError('str')

    __repr__ = __iter__ = __bool__ = __len__ = __fspath__ = __str__


class NotMade(Action):

    def __init__(self):
        pass


class Itself(Action):

    def execute(self, context):
        return [self]


class NoText(Substitution):

    def perform(self, context):
        return 5


@functools.cache
def _nested(depth):
    value = 'true'
    from launch.substitutions import NotSubstitution
    for _ in range(depth):
        value = NotSubstitution(value)
    return value


def _own_list():
    value = []
    value.append(value)
    return value


# Made anew for each case: a generator is used up by the first one. The nested substitution takes long, so it is made once.
VALUES = {
    'None': lambda: None, 'Ellipsis': lambda: ..., 'zero': lambda: 0, 'negative': lambda: -1, 'huge': lambda: 1 << 70,
    'float': lambda: 1.5, 'nan': lambda: float('nan'), 'infinite': lambda: float('inf'), 'complex': lambda: 1j,
    'True': lambda: True, 'bytes': lambda: b'x', 'bytearray': lambda: bytearray(b'x'), 'empty text': lambda: '',
    'text': lambda: 'x y', 'NUL': lambda: 'a\0b', 'surrogate': lambda: '\ud800', 'set': lambda: {'a', 'b'},
    'generator': lambda: (part for part in ('a', None)), 'endless': Endless, 'empty list': lambda: [],
    'list of None': lambda: [None], 'lists': lambda: [[[]], [['a', 5]]], 'own list': _own_list,
    'huge in a list': lambda: [1 << 70], 'pair': lambda: [('a', 'b')], 'pair of None': lambda: [(None, None)],
    'tuple': lambda: ('a', 'b', 'c'), 'empty mapping': lambda: {}, 'mapping of None': lambda: {'a': None},
    'None in a mapping': lambda: {None: 1}, 'list of mappings': lambda: [{'a': 1 << 70, 5: b'x'}],
    'object': object, 'class': lambda: int, 'class of substitutions': lambda: Substitution,
    'class of actions': lambda: LogInfo, 'module': lambda: os, 'function': lambda: lambda *_args, **_kwargs: 5,
    'unwilling': Unwilling, 'exception': lambda: ValueError('x'), 'action': lambda: LogInfo(msg=''),
    'action that is not made': NotMade, 'action of itself': Itself, 'substitution': Substitution, 'no text': NoText,
    'condition': Condition, 'nested': lambda: _nested(2000), 'process': lambda: ExecuteProcess(cmd=['true']),
}

# Arguments that are right, by their names; 'x' for all others.
RIGHT = {
    'actions': lambda: [], 'cmd': lambda: ['true'], 'period': lambda: 1.0, 'event': lambda: None,
    'process_description': lambda: importlib.import_module('launch.descriptions').Executable(cmd=['true']),
    'function': lambda: lambda *_args, **_kwargs: None, 'event_handler': lambda: _handler(),
    'target_action': lambda: ExecuteProcess(cmd=['true']), 'on_exit': lambda: [], 'on_start': lambda: [],
    'on_completion': lambda: [], 'on_shutdown': lambda: [], 'entities': lambda: [], 'length': lambda: 2,
    'target_lifecycle_node': lambda: Node(executable='/bin/true', name='n', namespace='/'),
    'process_matcher': lambda: importlib.import_module('launch.events').matches_action(ExecuteProcess(cmd=['true'])),
    'lifecycle_node_matcher': lambda: importlib.import_module('launch.events').matches_action(
        Node(executable='/bin/true', name='n', namespace='/')),
    'signal_number': lambda: 2, 'transition_id': lambda: 1, 'transition_ids': lambda: [1], 'package': lambda: 'demo',
    'lifecycle_node_names': lambda: ['n'], 'executable': lambda: '/bin/true', 'value': lambda: '1',
    'composable_node_descriptions': lambda: [], 'expression': lambda: 'true', 'predicate_expression': lambda: 'true',
    'left': lambda: 'true', 'right': lambda: 'true', 'condition': lambda: None, 'substitutions': lambda: ['a'],
    'command': lambda: 'echo', 'launch_description_source': lambda: LaunchDescriptionSource(LaunchDescription()),
    'values': lambda: {'process': 'x', 'pid': '1', 'exit_code': '1', 'text': 'x', 'stream': 'stdout',
                       'start_state': 'active', 'goal_state': 'inactive'},
    'action': lambda: LogInfo(msg=''), 'coroutine': lambda: _coroutine, 'input_values': lambda: '{a: 1}',
}


async def _coroutine(*_args):
    pass


def _handler():
    from launch.event_handlers import OnShutdown
    return OnShutdown(on_shutdown=[])


def modules():
    for name in PACKAGES:
        package = importlib.import_module(name)
        yield package
        for found in pkgutil.walk_packages(package.__path__, name + '.'):
            if found.name != 'launch_ros.ros_adapters':  # which needs rclpy
                yield importlib.import_module(found.name)


def callables():
    """Every public class and function of the packages, once."""
    seen = {}
    for module in modules():
        for name, value in vars(module).items():
            own = getattr(value, '__module__', None) or ''
            if name[0] == '_' or not (inspect.isclass(value) or inspect.isfunction(value)):
                continue
            if own.partition('.')[0] in PACKAGES and not own.rpartition('.')[2].startswith(
                    ('_coroutines', '_load', '_explain', '_names', '_places', '_entities', '_environment', '_values')):
                seen.setdefault(value, f'{own}.{name}')
    return sorted((name, value) for value, name in seen.items())


def methods(made):
    """What can be called of an object without arguments of its own."""
    for name in dir(type(made)):
        if name[0] != '_' or name == '__truediv__':
            yield name


def cases():
    """(name, callable, arguments, keyword arguments), the latter two as functions."""
    for name, made in callables():
        try:
            if inspect.isclass(made):  # else the arguments of __new__ would be told
                parameters = list(inspect.signature(made.__init__).parameters.values())[1:]
            else:
                parameters = list(inspect.signature(made).parameters.values())
        except (TypeError, ValueError):
            continue
        named = [p for p in parameters if p.kind in (p.POSITIONAL_OR_KEYWORD, p.KEYWORD_ONLY)]
        required = [p.name for p in named if p.default is p.empty]

        def right(names):
            return {name: RIGHT.get(name, lambda: 'x')() for name in names}

        yield f'{name}()', made, lambda: (), dict
        yield f'{name}(right)', made, lambda: (), lambda r=required: right(r)
        yield f'{name}(too many)', made, lambda: ('x',) * 12, dict
        yield f'{name}(unknown)', made, lambda: (), lambda r=required: {**right(r), 'no_such_argument': 1}
        for missing in required:
            yield f'{name}(without {missing})', made, lambda: (), lambda r=required, m=missing: right(
                n for n in r if n != m)
        keywords = [p.name for p in named]
        if any(p.kind is p.VAR_KEYWORD for p in parameters) and hasattr(made, '_ARGUMENTS'):
            keywords += [n for n in (*made._ARGUMENTS, *made._EXTENSIONS, 'depends_on') if n not in keywords]
        for of_value, value in VALUES.items():
            if of_value == 'endless' and not inspect.isclass(made):
                continue
            for keyword in keywords:
                yield (f'{name}({keyword}={of_value})', made, lambda: (),
                       lambda r=required, k=keyword, v=value: {**right(n for n in r if n != k), k: v()})
            for parameter in parameters:
                if parameter.kind is parameter.VAR_POSITIONAL:
                    yield f'{name}(*{of_value})', made, lambda v=value: (v(), v()), dict


def use(made):
    """Actions that make the launcher read and visit it."""
    if isinstance(made, Substitution):
        return [LogInfo(msg=made), ExecuteProcess(cmd=['true', made], name=made)]
    if isinstance(made, Condition):
        return [LogInfo(msg='', condition=made)]
    if isinstance(made, BaseEventHandler):
        return [RegisterEventHandler(made)]
    if isinstance(made, LaunchDescriptionSource):
        return [IncludeLaunchDescription(made)]
    if isinstance(made, ComposableNode):
        return [LoadComposableNodes(target_container='c', composable_node_descriptions=[made])]
    if isinstance(made, (Parameter, ParameterFile)):
        return [Node(executable='/bin/true', parameters=[made])]
    if isinstance(made, ParameterValue):
        return [Node(executable='/bin/true', parameters=[{'a': made}])]
    if isinstance(made, LaunchDescriptionEntity):
        return [made]
    if hasattr(made, '_tags'):
        return [EmitEvent(event=made)]
    return []


# Opened once: a file that is truncated and closed is written to the disk at once, which took most of the time.
_progress = os.environ.get('EVERY_VALUE_PROGRESS')
_progress = _progress and os.open(_progress, os.O_WRONLY | os.O_CREAT, 0o600)


def _try(context, number, call, arguments, keywords):
    if _progress:
        os.pwrite(_progress, b'%09d' % number, 0)
    made = call(*arguments(), **keywords())
    return use(made)


def generate_launch_description():
    only = os.environ.get('EVERY_VALUE_ONLY')
    description = LaunchDescription()
    names = []
    for number, (name, call, arguments, keywords) in enumerate(cases()):
        names.append(name)
        if only in (None, str(number)):
            description.add_action(OpaqueFunction(function=_try, args=[number, call, arguments, keywords]))
    listing = os.environ.get('EVERY_VALUE_NAMES')
    if listing:
        with open(listing, 'w') as file:
            file.write('\n'.join(names))
    return description
