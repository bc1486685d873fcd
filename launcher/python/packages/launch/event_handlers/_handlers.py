# SPDX-License-Identifier: Apache-2.0
"""The handlers that the launcher knows, each with a tag of its own."""

from launch._entities import entities, entity
from launch._places import name_of_function, of_function
from launch._values import LaunchFileError, WrongKind
from launch.action import Action
from launch.event_handler import BaseEventHandler
from launch.events import ExecutionComplete, Shutdown
from launch.events.process import ProcessExited, ProcessIO, ProcessStarted, action_named


def _values(context):
    prefix = 'event.'
    return {name[len(prefix):]: value for name, value in context.launch_configurations.items()
            if name.startswith(prefix)}


class _Call(Action):
    """Visits what the handler gives for the event that is being handled."""

    def __init__(self, handler, function, make_event):
        super().__init__()
        self._handler = handler
        self._function = function
        self._make_event = make_event

    def execute(self, context):
        event = self._make_event(_values(context))
        outer = dict(context._locals)
        context.extend_locals({'event': event})
        try:
            return self._function(event, context) if self._handler._is_meant(event) else None
        finally:
            context._locals = outer

    def _calls(self):
        called = [function for function in (self._function, self._handler._target) if _is_function(function)]
        return next(filter(None, map(name_of_function, called)), None) or 'a handler'

    def _place_of_execute(self):
        return of_function(self._function)


class _Handler(BaseEventHandler):
    """`given` are the actions, or a function of the event and the context."""

    _event_type = None

    def __init__(self, given, handle_once=False):
        super().__init__(handle_once=handle_once)
        self._given = given
        self._target = None

    def _is_meant(self, event):
        return True

    def matches(self, event):
        return isinstance(event, self._event_type) and self._is_meant(event)

    def handle(self, event, context):
        super().handle(event, context)
        return self._given(event, context) if callable(self._given) else self._given

    @property
    def handler_description(self):
        return repr(self._given) if callable(self._given) else '<actions>'

    @property
    def matcher_description(self):
        return f'event issubclass of {self._event_type.__name__}'

    def describe(self):
        text, actions = super().describe()
        return text, actions if callable(self._given) else [*actions, *entities_in(self._given)]

    # The entities that the launcher visits when the event happens.
    def _visited(self, given, make_event):
        if not _is_function(given) and not _is_function(self._target):
            return entities(given, self._place())
        function = given if _is_function(given) else lambda event, context: given
        call = _Call(self, function, make_event)
        call._made_at = None
        return [(tag, self._place(), *rest) for tag, _place, *rest in call._entities()]


def entities_in(given):
    return [given] if isinstance(given, Action) else list(given or [])


def _is_function(given):
    return callable(given) and not isinstance(given, Action)


class OnActionEventBase(_Handler):
    """A handler of the events of an action, of those that a function accepts, or of all."""

    def __init__(self, *, action_matcher=None, on_event=None, target_event_cls=None, target_action_cls=Action,
                 handle_once=False):
        super().__init__(on_event, handle_once)
        if action_matcher is not None and not _is_function(action_matcher) and (
                not isinstance(action_matcher, target_action_cls)):
            raise WrongKind(f'the action of {type(self).__name__} must be a {target_action_cls.__name__}, '
                            f'got {type(action_matcher).__name__}')
        self._target = action_matcher
        self._event_type = target_event_cls or self._event_type

    def _is_meant(self, event):
        if self._target is None:
            return True
        return bool(self._target(event.action)) if _is_function(self._target) else event.action is self._target


class _ProcessHandler(OnActionEventBase):

    def __init__(self, target_action, given, handle_once):
        from launch.actions._processes import name_of_process
        if target_action is not None and not _is_function(target_action):
            name_of_process(target_action, f'target_action of {type(self).__name__}')
        super().__init__(action_matcher=target_action, on_event=given, handle_once=handle_once)

    def _handler(self, tag, given, place, when, attributes=()):
        from launch.actions._processes import name_of_process
        target = self._target if isinstance(self._target, Action) else None
        process = None if target is None else name_of_process(target, 'target_action')
        event_type = self._event_type
        return entity(tag, place, [('process', process), *attributes, ('once', 'true' if self.handle_once else None),
                                   self._name_of_it(), *when],
                      self._visited(given, lambda values: event_type(target or action_named(values), values)))


class OnProcessStart(_ProcessHandler):
    _event_type = ProcessStarted

    def __init__(self, *, target_action=None, on_start, handle_once=False):
        super().__init__(target_action, on_start, handle_once)

    def _tags(self, place, when):
        return [self._handler('on_process_start', self._given, place, when)]


class OnProcessExit(_ProcessHandler):
    _event_type = ProcessExited

    def __init__(self, *, target_action=None, on_exit, handle_once=False):
        super().__init__(target_action, on_exit, handle_once)

    def _tags(self, place, when):
        return [self._handler('on_process_exit', self._given, place, when)]


class OnExecutionComplete(OnActionEventBase):
    """Called when an action was executed: a process when it has ended, a timer when it has fired, others at once."""

    _event_type = ExecutionComplete

    def __init__(self, *, target_action=None, on_completion, handle_once=False):
        super().__init__(action_matcher=target_action, on_event=on_completion, handle_once=handle_once)
        from launch.actions._processes import _Process
        self._is_of_process = isinstance(target_action, _Process)
        if isinstance(target_action, Action):
            target_action._is_watched = True
        else:
            Action._is_watched = True  # of all actions that are visited from now on

    def _tags(self, place, when):
        if not self._is_of_process:
            return super()._tags(place, when)
        target = self._target
        handler = OnProcessExit(target_action=target, on_exit=(
            self._given if not _is_function(self._given) else
            lambda _event, context: self._given(ExecutionComplete(action=target), context)),
            handle_once=self.handle_once)
        handler._made_at = self._made_at
        self._number = int(handler._name_of_it()[1].rpartition(' ')[2])
        return handler._tags(place, when)


class OnProcessIO(_ProcessHandler):
    _event_type = ProcessIO

    def __init__(self, *, target_action=None, on_stdin=None, on_stdout=None, on_stderr=None, handle_once=False):
        if on_stdin is not None:
            raise LaunchFileError('on_stdin is not supported: launched processes are given no input')

        # These functions get only the event.
        def without_context(function):
            return function and (lambda event, _context: function(event))

        super().__init__(target_action, None, handle_once)
        self._functions = [('stdout', without_context(on_stdout)), ('stderr', without_context(on_stderr))]

    def handle(self, event, context):
        BaseEventHandler.handle(self, event, context)
        function = dict(self._functions)['stdout' if event.from_stdout else 'stderr']
        return function and function(event, context)

    def _tags(self, place, when):
        return [self._handler('on_process_io', function, place, when, [('stream', stream)])
                for stream, function in self._functions if function is not None]


class OnShutdown(_Handler):
    _event_type = Shutdown

    def __init__(self, *, on_shutdown, handle_once=False):
        super().__init__(on_shutdown, handle_once)

    def _tags(self, place, when):
        def make_event(values):
            return Shutdown(reason=values.get('reason', ''), due_to_sigint='SIGINT' in values.get('reason', ''))

        return [entity('on_shutdown', place, [self._name_of_it(), *when], self._visited(self._given, make_event))]


class OnIncludeLaunchDescription(_Handler):
    """A handler of an event that only a LaunchService of one's own has; here it never happens."""

    def __init__(self, **kwargs):
        from launch.events import IncludeLaunchDescription
        super().__init__([], kwargs.get('handle_once', False))
        self._event_type = IncludeLaunchDescription
        self.entities = []

    def _tags(self, place, when):
        return []
