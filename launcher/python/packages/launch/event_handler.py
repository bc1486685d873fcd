"""Event handlers."""

from launch._places import Located
from launch._values import LaunchFileError


class BaseEventHandler(Located):

    def _tags(self, place, when):
        raise LaunchFileError(f'this launcher has no event handler {type(self).__name__}',
                              'launch.event_handlers has those for processes')


class EventHandler(BaseEventHandler):

    def __init__(self, **_kwargs):
        raise LaunchFileError('this launcher has no events that a matcher of your own could match',
                              'launch.event_handlers has handlers for processes')
