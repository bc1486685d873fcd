# SPDX-License-Identifier: Apache-2.0
"""Changes of the state of nodes with a managed life cycle."""

from launch import _names
from launch._dispatch import _Step
from launch._entities import entity
from launch._places import Located, name_of_function
from launch._values import LaunchFileError, function, text
from launch.event import Event
from launch.launch_context import LaunchContext
from launch_ros._transitions import name_of_transition
from lifecycle_msgs.msg import State, Transition


class _NodeMatcher:
    """A function of a node, which means the node of this name."""

    def __init__(self, name):
        self.node_name = name

    def __call__(self, action):
        return action.node_name == LaunchContext._of_launch()._perform(self.node_name)


def matches_node_name(node_name):
    return _NodeMatcher(text(node_name, 'node_name'))


class StateTransition(Event):
    """The event that handlers get: `action` is the node, the states are labels such as 'inactive'."""

    name = 'launch_ros.events.lifecycle.StateTransition'

    def __init__(self, action, values):
        self.action = action
        self.start_state = values['start_state']
        self.goal_state = values['goal_state']


class ChangeState(Located, Event):
    """Asks the nodes that the matcher accepts to change their state."""

    name = 'launch_ros.events.lifecycle.ChangeState'
    valid_transitions = {number: name for name, number in vars(Transition).items() if name.startswith('TRANSITION_')}
    valid_states = {number: name for name, number in vars(State).items() if name[0] != '_'}

    def __init__(self, *, lifecycle_node_matcher, transition_id):
        from launch_ros.actions._nodes import Node, full_name
        self.transition_id = transition_id
        self.lifecycle_node_matcher = function(lifecycle_node_matcher, 'lifecycle_node_matcher')
        self._transition = name_of_transition(transition_id)
        action = getattr(lifecycle_node_matcher, 'action', None)
        if action is not None and not isinstance(action, Node):
            raise LaunchFileError(f'lifecycle_node_matcher must match a node, got {type(action).__name__}')
        self._action = action
        self._node = (full_name(action),) if action is not None else getattr(lifecycle_node_matcher, 'node_name', None)

    def _tag(self, place, node, when):
        return entity('lifecycle_transition', place,
                      [('node', node), ('transitions', [(self._transition,)]), *when])

    def _tags(self, place, when):
        if self._node is not None and self._action is None:
            return [self._tag(place, self._node, when)]
        step = _Chosen(self) if self._action is None else _OfAction(self, place)
        step._made_at = self._made_at
        return [entity('', place, when, obj=step)]


class _Chosen(_Step):
    """The nodes that a matcher accepts, when it is asked."""

    def __init__(self, event):
        self._event = event

    def _calls(self):
        return name_of_function(self._event.lifecycle_node_matcher)

    def _do(self, context):
        from launch_ros.actions._nodes import full_name, lifecycle_nodes
        return [self._event._tag(None, (full_name(node),), []) for node in lifecycle_nodes
                if self._event.lifecycle_node_matcher(node)]


class _OfAction(_Step):
    """
    The node of an action that is visited by now, or else at the end of this traversal, as an event comes after it.

    An action that is not visited then has started no node whose state could change.
    """

    def __init__(self, event, place, at_the_end=False):
        self._event = event
        self._place_of_event = place
        self._at_the_end = at_the_end

    def _do(self, context):
        place = self._place_of_event
        if self._event._action._has_been_visited():
            return [self._event._tag(place, self._event._node, [])]
        if self._at_the_end:
            return [entity('log', place, [('level', ('WARNING',)), ('message', (
                'no state is changed, since the node of this event was not started',))])]
        later = _OfAction(self._event, place, at_the_end=True)
        later._made_at = self._made_at
        return [entity('timer', None, [('period', ('0',))], [entity('', place, [], obj=later)])]


_names.one_class_modules(__name__)
_names.same_module(__name__, __name__ + '.lifecycle_node_matchers', 'launch_ros.events.matchers',
                   'launch_ros.events.matchers.matches_node_name')
__path__ = []  # so that `import launch_ros.events.lifecycle.lifecycle_node_matchers` looks for it
