# SPDX-License-Identifier: Apache-2.0
"""Handlers of what happens to ROS nodes."""

from launch import _names
from launch._dispatch import _Step
from launch._entities import entity
from launch._values import LaunchFileError, function, text
from launch.event_handlers._handlers import _Handler
from launch_ros.events.lifecycle import StateTransition

# The state of a node while it makes the transition.
_ON_THE_WAY = {'configure': 'configuring', 'cleanup': 'cleaningup', 'activate': 'activating',
               'deactivate': 'deactivating', 'shutdown': 'shuttingdown'}


class OnStateTransition(_Handler):
    _event_type = StateTransition

    def __init__(self, *, entities, target_lifecycle_node=None, transition=None, start_state=None, goal_state=None,
                 matcher=None, handle_once=False):
        from launch_ros.actions._nodes import Node, full_name
        super().__init__(entities, handle_once)
        if not isinstance(target_lifecycle_node, Node):
            raise LaunchFileError(f'OnStateTransition needs target_lifecycle_node, a LifecycleNode, '
                                  f'got {type(target_lifecycle_node).__name__}')
        if transition is not None:
            if start_state is not None or goal_state is not None:
                raise LaunchFileError('transition goes with neither start_state nor goal_state')
            if transition not in _ON_THE_WAY:
                raise LaunchFileError(f'there is no transition {transition!r}', 'one of ' + ', '.join(_ON_THE_WAY))
            goal_state = _ON_THE_WAY[transition]
        self._node = (full_name(target_lifecycle_node),)
        self._node_action = target_lifecycle_node
        self._start_state = start_state
        self._goal_state = goal_state
        self._matcher = None if matcher is None else function(matcher, 'matcher')
        self._target = matcher

    @property
    def entities(self):
        return self._given

    def _is_meant(self, event):
        return self._matcher is None or bool(self._matcher(event))

    def _tags(self, place, when):
        step = _Registration(self)
        step._made_at = self._made_at
        return [entity('', place, when, obj=step)]

    def _tag(self):
        def given(state, what):
            return None if state is None else text(state, what)

        node = self._node_action
        return entity('on_state_transition', self._place(),
                      [('node', self._node), ('start_state', given(self._start_state, 'start_state')),
                       ('goal_state', given(self._goal_state, 'goal_state')),
                       ('once', 'true' if self.handle_once else None), self._name_of_it()],
                      self._visited(self._given, lambda values: StateTransition(node, values)))


class _Registration(_Step):
    """Registers the handler when its node has a name: now, or when the node is visited."""

    def __init__(self, handler):
        self._handler = handler

    def _do(self, context):
        node = self._handler._node_action
        if node._has_been_visited():
            return [self._handler._tag()]
        node._waiting_handlers.append(self._handler)
        return []


_names.one_class_modules(__name__)
