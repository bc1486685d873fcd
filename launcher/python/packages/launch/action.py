# SPDX-License-Identifier: Apache-2.0
"""Action: one thing that a launch file asks for."""

from launch import _dispatch, _outside
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

    def describe(self):
        return repr(self)

    def get_sub_entities(self):
        return []

    def describe_sub_entities(self):
        return self.get_sub_entities() if self.condition is None else []

    def describe_conditional_sub_entities(self):
        if self.condition is None:
            return []
        return [(f'Conditionally included by {self.describe()}', self.get_sub_entities())]

    @classmethod
    def parse(cls, entity, parser, ignore=None):
        """The class and the arguments that it takes from an element of XML or YAML."""
        from launch.frontend._arguments import arguments_of
        return cls, arguments_of(cls, entity, parser, ignore or ())

    def visit(self, context):
        if self.condition is None or self.condition.evaluate(context):
            return self.execute(context)
        return None

    def execute(self, context):
        if _outside.is_here() and _outside.execute(self, context):
            return None
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
        found = self._own_entities()
        if getattr(self, '_is_watched', False):
            self._tell_of_completion(found)
        return found

    def _own_entities(self):
        if type(self).visit is not Action.visit:
            return [entity('', self._place(), [], obj=self)]  # its visit() evaluates the condition
        if type(self).execute is Action.execute:
            return self._tags()
        return [entity('', self._place(), self._when(), obj=self)]

    # OnExecutionComplete asks for it. An action is complete when it was executed, unless it takes time.
    def _tell_of_completion(self, found):
        from launch.events import ExecutionComplete
        found.append(_dispatch.told_if_wanted(ExecutionComplete(action=self), self._place()))

    def _execute(self):
        from launch.launch_context import LaunchContext
        context = LaunchContext._of_launch()
        with told_at(self):
            if type(self).visit is not Action.visit:
                return entities(self.visit(context), of_function(type(self).visit))
            found = entities(self.execute(context), self._place_of_execute())
            future = self.get_asyncio_future() if _dispatch.is_of_file(type(self).get_asyncio_future) else None
            if future is not None:
                context.add_completion_future(future)
            return found

    # The function of the launch file that _execute() calls; a plan must not call it for an event.
    def _calls(self):
        called = name_of_function(type(self).visit) or name_of_function(type(self).execute)
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
