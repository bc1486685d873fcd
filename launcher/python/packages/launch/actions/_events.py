# SPDX-License-Identifier: Apache-2.0
"""Actions that deal with events."""

from launch._entities import entity
from launch._values import LaunchFileError, WrongKind
from launch.action import Action
from launch.event import Event
from launch.event_handler import BaseEventHandler


class RegisterEventHandler(Action):

    def __init__(self, event_handler, **kwargs):
        super().__init__(**kwargs)
        if not isinstance(event_handler, BaseEventHandler):
            raise WrongKind(f'event_handler must be an event handler, got {type(event_handler).__name__}')
        self._handler = event_handler

    @property
    def event_handler(self):
        return self._handler

    def _tags(self):
        return self._handler._tags(self._place(), self._when())


class UnregisterEventHandler(Action):

    def __init__(self, event_handler, **kwargs):
        super().__init__(**kwargs)
        if not isinstance(event_handler, BaseEventHandler):
            raise WrongKind(f'event_handler must be an event handler, got {type(event_handler).__name__}')
        self._handler = event_handler

    @property
    def event_handler(self):
        return self._handler

    def _tags(self):
        return [entity('unregister_event_handler', self._place(), [self._handler._name_of_it(), *self._when()])]


class EmitEvent(Action):

    def __init__(self, *, event, **kwargs):
        super().__init__(**kwargs)
        if not isinstance(event, Event) or not hasattr(event, '_tags'):
            raise LaunchFileError(f'this launcher can\'t emit {type(event).__name__}',
                                  'it can emit Shutdown, ShutdownProcess, SignalProcess and ChangeState')
        self._event = event

    @property
    def event(self):
        return self._event

    def _tags(self):
        return self._event._tags(self._place(), self._when())
