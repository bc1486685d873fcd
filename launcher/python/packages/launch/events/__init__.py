"""Events that a launch file can emit, and what is told of those that a handler gets."""

from launch import _names
from launch._entities import entity
from launch._places import Located
from launch._values import text
from launch.event import Event


class Shutdown(Located, Event):

    def __init__(self, *, reason='reason not given', due_to_sigint=False):
        self.reason = reason
        self.due_to_sigint = due_to_sigint
        self._reason = text(reason, 'reason')

    def _tags(self, place, when):
        return [entity('shutdown', place, [('reason', self._reason), *when])]


_names.one_class_modules(__name__)

from launch.events import process  # noqa: E402  it takes names of this module
