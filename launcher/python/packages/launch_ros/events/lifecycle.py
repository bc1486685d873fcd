# SPDX-License-Identifier: Apache-2.0
"""Changes of the state of nodes with a managed life cycle."""

from launch import _names
from launch._entities import entity
from launch._places import Located
from launch._values import LaunchFileError, text
from launch.event import Event
from lifecycle_msgs.msg import Transition

NAMES = {Transition.TRANSITION_CONFIGURE: 'configure', Transition.TRANSITION_CLEANUP: 'cleanup',
         Transition.TRANSITION_ACTIVATE: 'activate', Transition.TRANSITION_DEACTIVATE: 'deactivate',
         Transition.TRANSITION_UNCONFIGURED_SHUTDOWN: 'shutdown', Transition.TRANSITION_INACTIVE_SHUTDOWN: 'shutdown',
         Transition.TRANSITION_ACTIVE_SHUTDOWN: 'shutdown'}


def name_of_transition(transition_id):
    if transition_id not in NAMES:
        raise LaunchFileError(f'a launch file can\'t ask for the transition {transition_id!r}')
    return NAMES[transition_id]


def matches_node_name(node_name):
    return text(node_name, 'node_name')


class StateTransition(Event):
    """The event that handlers get: `action` is the node, the states are labels such as 'inactive'."""

    name = 'launch_ros.events.lifecycle.StateTransition'

    def __init__(self, action, values):
        self.action = action
        self.start_state = values['start_state']
        self.goal_state = values['goal_state']


class ChangeState(Located, Event):

    def __init__(self, *, lifecycle_node_matcher, transition_id):
        from launch.events.process import _Matcher
        from launch_ros.actions._nodes import Node, full_name
        self.transition_id = transition_id
        self._transition = name_of_transition(transition_id)
        if isinstance(lifecycle_node_matcher, _Matcher):
            action = lifecycle_node_matcher._action
            if not isinstance(action, Node):
                raise LaunchFileError(f'lifecycle_node_matcher must match a node, got {type(action).__name__}')
            lifecycle_node_matcher = (full_name(action),)
        if not isinstance(lifecycle_node_matcher, tuple):
            raise LaunchFileError('lifecycle_node_matcher must be one of the launcher\'s',
                                  'write launch.events.matches_action(node)')
        self._node = lifecycle_node_matcher

    def _tags(self, place, when):
        return [entity('lifecycle_transition', place,
                       [('node', self._node), ('transitions', [(self._transition,)]), *when])]


_names.one_class_modules(__name__)
