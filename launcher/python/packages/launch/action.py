# SPDX-License-Identifier: Apache-2.0
"""Action: one thing that a launch file asks for."""

from launch._entities import entities, entity, told_at
from launch._values import LaunchFileError, WrongKind, reject
from launch._places import name_of_function, of_function
from launch.condition import Condition
from launch.launch_description_entity import LaunchDescriptionEntity


# The arguments whose names in Python differ from the attributes of XML.
_ARGUMENTS = {'args': 'arguments', 'clean_env': 'env', 'default': 'default_value', 'exec': 'executable',
              'file': 'launch_description_source', 'from': 'src', 'launch-prefix': 'prefix', 'message': 'msg',
              'pkg': 'package', 'ros_args': 'ros_arguments', 'stderr': 'output', 'stdout': 'output',
              'target': 'target_container', 'to': 'dst'}


class Action(LaunchDescriptionEntity):
    """
    A base class for the actions of launch files: execute() returns the actions to visit in its place.

    The launcher's own actions implement _tags() instead, which gives entities.
    """

    def __init__(self, *, condition=None, **unknown):
        reject(type(self), unknown, ['condition'])
        if condition is not None and not isinstance(condition, Condition):
            raise WrongKind(f'condition of {type(self).__name__} must be a Condition, '
                            f'got {type(condition).__name__}', 'write IfCondition(…)')
        self._condition = condition

    @property
    def condition(self):
        return getattr(self, '_condition', None)

    def visit(self, context):
        if self.condition is None or self.condition.evaluate(context):
            return self.execute(context)
        return None

    def execute(self, context):
        return [_Plain(self)]

    def _with_places(self, attributes):
        """Attributes with the places of the arguments that they come from."""
        return [attribute if len(attribute) > 2 or attribute[1] is None else
                (*attribute, self._place_of(_ARGUMENTS.get(attribute[0]) or attribute[0].replace('-', '_')))
                for attribute in attributes]

    # The pairs for `if` and `unless`.
    def _when(self):
        return [] if self.condition is None else [self.condition._attribute()]

    def _tags(self):
        raise LaunchFileError(f'{type(self).__name__} has no execute()')

    def _entities(self):
        if type(self).execute is Action.execute:
            return self._tags()
        return [entity('', self._place(), self._when(), obj=self)]

    def _execute(self):
        from launch.launch_context import LaunchContext
        with told_at(self):
            return entities(self.execute(LaunchContext._of_launch()), self._place_of_execute())

    # The function of the launch file that _execute() calls; a plan must not call it for an event.
    def _calls(self):
        called = name_of_function(type(self).execute)
        function = getattr(self, '_function', None)
        if called is None and function is not None:
            return name_of_function(function) or 'a function'
        return called

    def _place_of_execute(self):
        return of_function(type(self).execute)


class _Plain(LaunchDescriptionEntity):
    """One of the launcher's own actions, without the execute() of a class derived from it."""

    def __init__(self, action):
        self._action = action

    def _entities(self):
        # The launcher has evaluated its condition already.
        return [(tag, place, [pair for pair in attributes if pair[0] not in ('if', 'unless')], *rest)
                for tag, place, attributes, *rest in self._action._tags()]
