# SPDX-License-Identifier: Apache-2.0
"""Actions that hold other actions, or that make them when they are visited."""

import _launch_engine
from launch._entities import entities, entity
from launch._places import of_function
from launch._values import (LaunchFileError, WrongKind, boolean, function as callable_of, items, mapping, number, pairs, reject,
                            text)
from launch.action import Action
from launch.launch_description_source import LaunchDescriptionSource
from launch.launch_description_sources import AnyLaunchDescriptionSource
from launch.substitutions import parts_of


class GroupAction(Action):
    # Arguments that only this launcher has, named as in XML.
    _EXTENSIONS = ('name', 'ns', 'machine', 'memory_max', 'memory_high', 'cpu_quota', 'cpu_weight', 'io_weight',
                   'pids_max')

    def __init__(self, actions, *, scoped=True, forwarding=True, launch_configurations=None, condition=None, **extensions):
        reject(type(self), [each for each in extensions if each not in self._EXTENSIONS],
               ['scoped', 'forwarding', 'launch_configurations', 'condition', *self._EXTENSIONS])
        super().__init__(condition=condition)
        self._actions = actions
        self._extensions = [(name, number(value, name)) for name, value in extensions.items() if value is not None]
        self._scoped = boolean(scoped, 'scoped')
        self._forwarding = boolean(forwarding, 'forwarding')
        self._keep = pairs(mapping(launch_configurations, 'launch_configurations'), 'launch_configurations')

    def get_sub_entities(self):
        return list(self._actions)

    def _tags(self):
        keep = [entity('keep', self._place(), [('name', name), ('value', value)]) for name, value in self._keep]
        attributes = [] if self._scoped == 'true' else [('scoped', self._scoped)]
        attributes += [] if self._forwarding == 'true' else [('forwarding', self._forwarding)]
        return [entity('group', self._place(), self._with_places([*attributes, *self._extensions, *self._when()]),
                       keep + entities(self._actions, self._place()))]


class IncludeLaunchDescription(Action):

    def __init__(self, launch_description_source, *, launch_arguments=None, scoped=None, machine=None, **kwargs):
        super().__init__(**kwargs)
        self._machine = [] if machine is None else [('machine', text(machine, 'machine'))]  # of this launcher, too
        self._scoped = None if scoped is None else boolean(scoped, 'scoped')  # an extension of this launcher
        if not isinstance(launch_description_source, LaunchDescriptionSource):
            launch_description_source = AnyLaunchDescriptionSource(launch_description_source)
        self._source = launch_description_source
        self._arguments = pairs([] if launch_arguments is None else launch_arguments, 'launch_arguments')

    @property
    def launch_description_source(self):
        return self._source

    @property
    def launch_arguments(self):
        return [(parts_of(name), parts_of(value)) for name, value in self._arguments]

    def describe(self):
        return f'IncludeLaunchDescription({self._source.location})'

    def get_sub_entities(self):
        return [] if self._source._description is None else [self._source._description]

    def _tags(self):
        place = self._place()
        if self._source._description is not None:
            arguments = [entity('let', place, [('name', name), ('value', value)]) for name, value in self._arguments]
            # The machine ends with the file.
            scoped = self._scoped or ('true' if self._machine else 'false')
            return [entity('group', place, [('scoped', scoped), *self._machine, *self._when()],
                           arguments + entities(self._source._description))]
        arguments = [entity('arg', place, [('name', name), ('value', value)]) for name, value in self._arguments]
        scoped = [] if self._scoped is None else [('scoped', self._scoped)]
        return [entity('include', place, self._with_places([('file', self._source._path), *scoped, *self._machine,
                                                           *self._when()]),
                       arguments)]


class OpaqueFunction(Action):
    """Calls function(context, *args, **kwargs) when it is visited; the actions that it returns are visited."""

    def __init__(self, *, function, args=None, kwargs=None, **left_over_kwargs):
        super().__init__(**left_over_kwargs)
        self._function = callable_of(function, 'function')
        self._args = items(args or [], 'args')
        self._kwargs = dict(kwargs or {})

    def execute(self, context):
        return self._function(context, *self._args, **self._kwargs)

    def _place_of_execute(self):
        return of_function(self._function) or self._place()


class OpaqueCoroutine(Action):
    """
    Runs coroutine(context, *args, **kwargs) beside the processes, from when they start.

    The launch goes on until it has returned; a shutdown cancels it. If it raises an error, the launch ends.
    """

    def __init__(self, *, coroutine, args=None, kwargs=None, ignore_context=False, **left_over_kwargs):
        super().__init__(**left_over_kwargs)
        from asyncio import iscoroutinefunction  # here, because most launch files need nothing of asyncio
        if not iscoroutinefunction(coroutine):
            raise WrongKind(f'coroutine must be an async function, got {type(coroutine).__name__}',
                            'write it with async def')
        self._coroutine = coroutine
        self._args = items(args or [], 'args')
        self._kwargs = dict(kwargs or {})
        self._ignore_context = ignore_context

    def describe(self):
        return getattr(self._coroutine, '__qualname__', 'a coroutine')

    def execute(self, context):
        _launch_engine.run_coroutine(self)

    # The launcher calls it when everything before it has begun.
    def _start(self):
        from launch import _coroutines
        from launch.launch_context import LaunchContext
        context = [] if self._ignore_context else [LaunchContext._of_launch()]
        _coroutines.start(self._coroutine(*context, *self._args, **self._kwargs), self)


# More than any launch has: a mistyped length must not fill the memory.
_MOST_TURNS = 100_000


class _Turn(Action):
    """One turn of a loop of an XML or YAML file: its actions, and the values that they get by their names."""

    def __init__(self, values, actions, place):
        super().__init__()
        self._values, self._actions, self._place_of_loop = values, actions, place

    def _tags(self):
        import yaml
        values = yaml.safe_dump(self._values, default_flow_style=True, width=float('inf'))
        return [entity('for_each', self._place_of_loop or self._place(), [('values', text(values.strip(), 'values'))],
                       entities(self._actions, self._place()))]


class ForLoop(Action):
    """Calls function(i) for each i from 0 to length - 1; the actions that it returns are visited."""

    def __init__(self, length, *, function=None, name=None, **kwargs):
        super().__init__(**kwargs)
        self._length = text(str(length) if isinstance(length, int) else length, 'length')
        self._function = callable_of(function, 'function')
        self._name = name

    @property
    def length(self):
        return parts_of(self._length)

    @property
    def function(self):
        return self._function

    @property
    def name(self):
        return self._name

    def execute(self, context):
        length = int(context._perform(self._length))
        if length > _MOST_TURNS:
            raise LaunchFileError(f'the loop has {length} turns, more than {_MOST_TURNS}')
        return [self._function(index) for index in range(length)]


class ForEach(Action):
    """Calls function(**values) for each of the YAML mappings, separated by semicolons, and visits what it returns."""

    def __init__(self, input_values, *, function=None, **kwargs):
        super().__init__(**kwargs)
        self._values = text(input_values, 'input_values')
        self._function = callable_of(function, 'function')

    @property
    def input_values(self):
        return parts_of(self._values)

    @property
    def function(self):
        return self._function

    def execute(self, context):
        import yaml
        turns = [turn for turn in context._perform(self._values).split(';') if turn.strip()]
        values = [yaml.safe_load(turn) for turn in turns]
        return [self._function(**of_turn) for of_turn in values if of_turn is not None]


class _Log(Action):
    _level = None

    def __init__(self, *, msg, level=None, **kwargs):
        super().__init__(**kwargs)
        self._msg = text(msg, 'msg')
        self._given_level = text('info' if level is None else level, 'level')

    @property
    def msg(self):
        return parts_of(self._msg)

    @property
    def level(self):
        return parts_of(self._given_level)

    def _tags(self):
        attributes = self._with_places([('message', self._msg), *self._when()])
        if self._level is not None:
            return [entity(f'log_{self._level}', self._place(), attributes)]
        return [entity('log', self._place(), [*attributes, ('level', self._given_level)])]


class Log(_Log):
    pass


class LogDebug(_Log):
    _level = 'debug'


class LogInfo(_Log):
    _level = 'info'


class LogWarning(_Log):
    _level = 'warning'


class LogError(_Log):
    _level = 'error'


class Shutdown(Action):

    def __init__(self, *, reason='reason not given', **kwargs):
        super().__init__(**kwargs)
        self._reason = text(reason, 'reason')

    @property
    def event(self):
        from launch.events import Shutdown as Event
        return Event(reason=self._reason)

    def _tags(self):
        return [entity('shutdown', self._place(), [('reason', self._reason), *self._when()])]


