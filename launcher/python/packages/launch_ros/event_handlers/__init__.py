# SPDX-License-Identifier: Apache-2.0
"""Handlers of what happens to ROS nodes."""

from launch import _names
from launch._entities import entity
from launch._values import LaunchFileError, text
from launch.event_handler import BaseEventHandler
from launch.event_handlers import _actions
from launch_ros.events.lifecycle import StateTransition

# The state of a node while it makes the transition.
_ON_THE_WAY = {'configure': 'configuring', 'cleanup': 'cleaningup', 'activate': 'activating',
               'deactivate': 'deactivating', 'shutdown': 'shuttingdown'}


class OnStateTransition(BaseEventHandler):

    def __init__(self, *, entities, target_lifecycle_node=None, transition=None, start_state=None, goal_state=None,
                 matcher=None, handle_once=False):
        from launch_ros.actions._nodes import Node, full_name
        if matcher is not None:
            raise LaunchFileError('a matcher is not supported', 'give target_lifecycle_node, start_state and goal_state')
        if not isinstance(target_lifecycle_node, Node):
            raise LaunchFileError(f'OnStateTransition needs target_lifecycle_node, a LifecycleNode, '
                                  f'got {type(target_lifecycle_node).__name__}')
        if transition is not None:
            if start_state is not None or goal_state is not None:
                raise LaunchFileError('transition goes with neither start_state nor goal_state')
            if transition not in _ON_THE_WAY:
                raise LaunchFileError(f'there is no transition {transition!r}', 'one of ' + ', '.join(_ON_THE_WAY))
            goal_state = _ON_THE_WAY[transition]
        self._target = target_lifecycle_node
        self._node = (full_name(target_lifecycle_node),)
        self._start_state = start_state
        self._goal_state = goal_state
        self._once = handle_once
        self._given = entities

    def _tags(self, place, when):
        def given(state, what):
            return None if state is None else text(state, what)

        target = self._target
        return [entity('on_state_transition', place,
                       [('node', self._node), ('start_state', given(self._start_state, 'start_state')),
                        ('goal_state', given(self._goal_state, 'goal_state')), ('once', 'true' if self._once else None),
                        self._name_of_it(), *when],
                       _actions(self._given, lambda values: StateTransition(target, values), self._place()))]


_names.one_class_modules(__name__)
