# SPDX-License-Identifier: Apache-2.0
"""Events that a launch file can emit, and events that handlers get."""

from launch import _names
from launch._entities import entity
from launch._places import Located
from launch._values import text
from launch.event import Event
from launch.events import process
from launch.events.process import matches_action


class Shutdown(Located, Event):
    name = 'launch.events.Shutdown'

    def __init__(self, *, reason='reason not given', due_to_sigint=False):
        self.reason = reason
        self.due_to_sigint = due_to_sigint
        self._reason = text(reason, 'reason')

    def _tags(self, place, when):
        return [entity('shutdown', place, [('reason', self._reason), *when])]


class ExecutionComplete(Event):
    """An action was executed, and what it has begun has ended."""

    name = 'launch.events.ExecutionComplete'

    def __init__(self, action, _values=None):
        self.action = action


class IncludeLaunchDescription(Event):
    """An event of ROS 2; an include is no event here."""

    name = 'launch.events.IncludeLaunchDescription'

    def __init__(self, launch_description):
        self.launch_description = launch_description


class TimerEvent(Event):
    """A timer has fired. Handlers of the launch file get it after the timer's actions were visited."""

    name = 'launch.events.TimerEvent'

    def __init__(self, *, timer_action):
        self.timer_action = timer_action


_names.one_class_modules(__name__)
_names.same_module('launch.events.process', 'launch.events.matchers')
__all__ = ['Shutdown', 'matches_action', 'process']
