# SPDX-License-Identifier: Apache-2.0
"""Event handlers."""

import itertools

from launch import _dispatch
from launch._entities import entity
from launch._places import Located
from launch._values import function

_numbers = itertools.count(1)


class BaseEventHandler(Located):
    """A handler of the events that its matcher, or its own matches(), accepts."""

    def __init__(self, *, matcher=None, handle_once=False):
        self._matcher = None if matcher is None else function(matcher, 'matcher')
        self.handle_once = handle_once

    @property
    def handler_description(self):
        return None

    @property
    def matcher_description(self):
        return None

    def matches(self, event):
        return bool(self._matcher(event)) if self._matcher is not None else False

    def handle(self, event, context):
        """The entities to visit. A class of a launch file calls this method in its own one, as in ROS 2."""
        context.extend_locals({'event': event})
        if self.handle_once:
            context.unregister_event_handler(self)
        return None

    def describe(self):
        """A text, and the entities that are always visited."""
        return (f"{type(self).__name__}(matcher='{self.matcher_description}', handler='{self.handler_description}', "
                f'handle_once={self.handle_once})', [])

    # The attribute by which UnregisterEventHandler means this handler and no other.
    def _name_of_it(self):
        if '_number' not in self.__dict__:
            self._number = next(_numbers)
        return 'name', f'event handler {self._number}'

    # Whether a class of the launch file decides itself what the handler does.
    def _is_overridden(self):
        return any(_dispatch.is_of_file(getattr(type(self), name)) for name in ('matches', 'handle'))

    # Handlers that the launcher knows have a tag of their own; all others are asked for every event.
    def _tags(self, place, when):
        return [entity('', place, when, obj=_dispatch.Registration(self))]

    def _all_tags(self, place, when):
        return BaseEventHandler._tags(self, place, when) if self._is_overridden() else self._tags(place, when)


class EventHandler(BaseEventHandler):
    """Visits its entities when its matcher accepts an event."""

    def __init__(self, *, matcher, entities=None, handle_once=False):
        super().__init__(matcher=matcher, handle_once=handle_once)
        self._handled = entities

    @property
    def entities(self):
        return self._handled

    def handle(self, event, context):
        super().handle(event, context)
        return self._handled

    def describe(self):
        text, actions = super().describe()
        return text, [*actions, *(self._handled or [])]
