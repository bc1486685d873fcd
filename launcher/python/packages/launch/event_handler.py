# SPDX-License-Identifier: Apache-2.0
"""Event handlers."""

import itertools

from launch._places import Located
from launch._values import LaunchFileError


_numbers = itertools.count(1)


class BaseEventHandler(Located):

    # The attribute by which UnregisterEventHandler means this handler and no other.
    def _name_of_it(self):
        if '_number' not in self.__dict__:
            self._number = next(_numbers)
        return 'name', f'event handler {self._number}'

    def _tags(self, place, when):
        raise LaunchFileError(f'this launcher has no event handler {type(self).__name__}',
                              'launch.event_handlers has those for processes')


class EventHandler(BaseEventHandler):

    def __init__(self, **_kwargs):
        raise LaunchFileError('this launcher has no events that a matcher of your own could match',
                              'launch.event_handlers has handlers for processes')
