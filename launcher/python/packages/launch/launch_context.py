# SPDX-License-Identifier: Apache-2.0
"""LaunchContext: the state of the launch while it is visited."""

import types

import _launch_engine
from launch import _environment, _outside
from launch._places import caller, resolve
from launch._values import LaunchFileError, items


class LaunchContext:
    """
    The launch's state, which an OpaqueFunction and the like are called with.

    A context that a launch file makes itself has configurations of its own and the launch's environment.
    """

    _launch = None

    def __init__(self, *, argv=None, noninteractive=False):
        self.argv = items(argv or [], 'argv')
        self.noninteractive = noninteractive
        self.launch_configurations = {}
        self._locals = {}
        self._globals = {}

    @classmethod
    def _of_launch(cls):
        if cls._launch is None:
            import sys
            cls._launch = cls(argv=sys.argv[2:])
            cls._launch.launch_configurations = _environment.configurations
        return cls._launch

    @property
    def environment(self):
        return _environment.environment

    @property
    def is_shutdown(self):
        return False

    @property
    def asyncio_loop(self):
        """The loop that coroutines of launch files run on."""
        from launch import _coroutines
        return _coroutines.loop()

    def emit_event_sync(self, event):
        """Emits the event, as EmitEvent does."""
        self._emit(event, caller())

    def _emit(self, event, instruction):
        from launch.actions._events import tags_of_event
        _launch_engine.visit(tags_of_event(event, resolve(instruction), []))

    async def emit_event(self, event):
        self.emit_event_sync(event)

    def register_event_handler(self, event_handler, append=False):
        _launch_engine.visit(event_handler._all_tags(resolve(caller()), []))

    def unregister_event_handler(self, event_handler):
        from launch import _dispatch
        from launch._entities import entity
        if not _dispatch.unregister(event_handler):
            _launch_engine.visit([entity('unregister_event_handler', resolve(caller()), [event_handler._name_of_it()])])

    def would_handle_event(self, event):
        from launch import _dispatch
        return _dispatch.would_handle(event)

    def add_completion_future(self, completion_future):
        """The launch goes on until the future is done."""
        from launch import _coroutines
        _launch_engine.run_coroutine(_coroutines.Awaited(completion_future))

    def perform_substitution(self, substitution):
        return substitution.perform(self)

    def extend_locals(self, extensions):
        self._locals.update(extensions)

    def extend_globals(self, extensions):
        self._globals.update(extensions)

    def get_locals_as_dict(self):
        return {**self._globals, **self._event(), **self._locals}

    def _event(self):
        """The event that is being handled, for LocalSubstitution('event.…')."""
        from launch.events import process
        values = {name[len('event.'):]: value for name, value in self.launch_configurations.items()
                  if name.startswith('event.')}
        if 'process' not in values:
            return {'event': types.SimpleNamespace(**values)} if values else {}
        kind = (process.ProcessExited if 'exit_code' in values else
                process.ProcessIO if 'text' in values else process.ProcessStarted)
        return {'event': kind(process.action_named(values), values)}

    @property
    def locals(self):  # noqa: A003  ROS 2's name
        return types.SimpleNamespace(**self.get_locals_as_dict())

    def _perform(self, value):
        if _outside.is_here():
            return _outside.perform(value, self)
        if isinstance(self.launch_configurations, dict):
            return _launch_engine.perform(value, self.launch_configurations)
        return _launch_engine.perform(value)

    def __getattr__(self, name):
        if name[:2] == '__':
            raise AttributeError(name)
        raise LaunchFileError(f"this launcher's LaunchContext has no '{name}'")
