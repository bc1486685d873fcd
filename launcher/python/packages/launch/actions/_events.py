# SPDX-License-Identifier: Apache-2.0
"""Actions that deal with events."""

from launch import _dispatch
from launch._entities import entity
from launch._values import WrongKind
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
        return self._handler._all_tags(self._place(), self._when())


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
        place = self._place()
        return [entity('', place, self._when(), obj=_Unregistration(self._handler))]


class _Unregistration(_dispatch._Step):
    """Unregisters a handler of either kind."""

    def __init__(self, handler):
        self._handler = handler

    def _do(self, context):
        if _dispatch.unregister(self._handler):
            return []
        return [entity('unregister_event_handler', self._place(), [self._handler._name_of_it()])]


class EmitEvent(Action):

    def __init__(self, *, event, **kwargs):
        super().__init__(**kwargs)
        if not isinstance(event, Event):
            raise WrongKind(f'event must be an Event, got {type(event).__name__}')
        self._event = event

    @property
    def event(self):
        return self._event

    def _tags(self):
        return tags_of_event(self._event, self._place(), self._when())


def tags_of_event(event, place, when):
    """An event that asks something of the launcher, or one for the handlers of the launch file."""
    if hasattr(event, '_tags'):
        return event._tags(place, when)
    return [_dispatch.emission(event, place, when)]
