# SPDX-License-Identifier: Apache-2.0
"""Actions that ROS 2 does not have. A launch file that imports them runs with this launcher alone."""

from launch._entities import entities, entity
from launch._values import number, text
from launch.action import Action


class WaitFor(Action):
    """Visits its actions once the ROS graph shows a node (in a state), a topic or a service; <wait_for> in XML."""

    def __init__(self, actions, *, node=None, topic=None, service=None, state=None, message=False, **kwargs):
        super().__init__(**kwargs)
        self._attributes = [(name, text(value, name)) for name, value in
                            (('node', node), ('topic', topic), ('service', service), ('state', state))
                            if value is not None]
        if message:
            self._attributes.append(('condition', 'message'))
        self._actions = actions

    def get_sub_entities(self):
        return self._actions

    def _tags(self):
        return [entity('wait_for', self._place(), self._with_places([*self._attributes, *self._when()]),
                       entities(self._actions, self._place()))]


class RestartProcess(Action):
    """Ends the process of an action, or the process with a name, and starts it again; <restart> in XML."""

    def __init__(self, process, **kwargs):
        from launch.actions._processes import name_of_process
        super().__init__(**kwargs)
        self._process = name_of_process(process, 'process') if isinstance(process, Action) else text(process, 'process')

    def _tags(self):
        return [entity('restart', self._place(), [('process', self._process), *self._when()])]


__all__ = ['RestartProcess', 'WaitFor']
