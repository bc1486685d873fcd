# SPDX-License-Identifier: Apache-2.0
"""
Handlers of what happens to processes and to the launch.

A handler has a list of actions, or a function of the event and the context that returns actions.
"""

from launch import _names
from launch._entities import entities, entity
from launch._places import of_function
from launch._values import LaunchFileError
from launch.action import Action
from launch.event_handler import BaseEventHandler
from launch.events import Shutdown
from launch.events.process import ProcessExited, ProcessIO, ProcessStarted


def _values(context):
    prefix = 'event.'
    return {name[len(prefix):]: value for name, value in context.launch_configurations.items()
            if name.startswith(prefix)}


class _Call(Action):
    """Calls a function with the event that is being handled, and visits the actions that it returns."""

    def __init__(self, function, make_event):
        super().__init__()
        self._function = function
        self._make_event = make_event

    def execute(self, context):
        return self._function(self._make_event(_values(context)), context)

    def _place_of_execute(self):
        return of_function(self._function)


def _actions(given, make_event, place):
    if callable(given) and not isinstance(given, Action):
        call = _Call(given, make_event)
        call._made_at = None
        return [(tag, place, *rest) for tag, _place, *rest in call._entities()]
    return entities(given, place)


class _ProcessHandler(BaseEventHandler):

    def __init__(self, target_action, handlers, handle_once):
        from launch.actions._processes import name_of_process
        if target_action is not None:
            name_of_process(target_action, f'target_action of {type(self).__name__}')
        self._target = target_action
        self._handlers = handlers
        self._once = handle_once

    def _handler(self, tag, given, event_type, place, when, attributes=()):
        from launch.actions._processes import name_of_process
        process = None if self._target is None else name_of_process(self._target, 'target_action')
        target = self._target
        return entity(tag, place, [('process', process), *attributes, ('once', 'true' if self._once else None),
                                   self._name_of_it(), *when],
                      _actions(given, lambda values: event_type(target, values), self._place()))


class OnProcessStart(_ProcessHandler):

    def __init__(self, *, target_action=None, on_start, handle_once=False):
        super().__init__(target_action, on_start, handle_once)

    def _tags(self, place, when):
        return [self._handler('on_process_start', self._handlers, ProcessStarted, place, when)]


class OnProcessExit(_ProcessHandler):

    def __init__(self, *, target_action=None, on_exit, handle_once=False):
        super().__init__(target_action, on_exit, handle_once)

    def _tags(self, place, when):
        return [self._handler('on_process_exit', self._handlers, ProcessExited, place, when)]


class OnExecutionComplete(_ProcessHandler):
    """For actions that run a process: called when the process has ended."""

    def __init__(self, *, target_action, on_completion, handle_once=False):
        super().__init__(target_action, on_completion, handle_once)

    def _tags(self, place, when):
        return [self._handler('on_process_exit', self._handlers, ProcessExited, place, when)]


class OnProcessIO(_ProcessHandler):

    def __init__(self, *, target_action=None, on_stdin=None, on_stdout=None, on_stderr=None, handle_once=False):
        if on_stdin is not None:
            raise LaunchFileError('on_stdin is not supported: launched processes are given no input')

        # These functions get only the event.
        def without_context(function):
            return function and (lambda event, _context: function(event))

        super().__init__(target_action, [('stdout', without_context(on_stdout)),
                                         ('stderr', without_context(on_stderr))], handle_once)

    def _tags(self, place, when):
        return [self._handler('on_process_io', function, ProcessIO, place, when, [('stream', stream)])
                for stream, function in self._handlers if function is not None]


class OnShutdown(BaseEventHandler):

    def __init__(self, *, on_shutdown, handle_once=False):
        self._on_shutdown = on_shutdown

    def _tags(self, place, when):
        def make_event(values):
            return Shutdown(reason=values.get('reason', ''), due_to_sigint='SIGINT' in values.get('reason', ''))

        return [entity('on_shutdown', place, [self._name_of_it(), *when], _actions(self._on_shutdown, make_event, self._place()))]


class OnActionEventBase(BaseEventHandler):
    """A class of ROS 2, where the handlers of processes derive from it."""


class OnIncludeLaunchDescription(BaseEventHandler):
    """Not supported: an include is no event here."""


_names.one_class_modules(__name__)
_names.same_module(__name__, __name__ + '.on_process_io')
