# SPDX-License-Identifier: Apache-2.0
"""Condition: whether an action is executed."""

from launch._places import Located, name_of_function
from launch._values import function


class Condition(Located):
    """A predicate of the context. The classes for most uses are in launch.conditions."""

    def __init__(self, *, predicate=None):
        self._predicate = None if predicate is None else function(predicate, 'predicate')

    def evaluate(self, context):
        if self._predicate is None:
            raise NotImplementedError(f'{type(self).__name__} has no predicate')
        return self._predicate(context)

    def _predicate_func(self, context):
        """A name that files of ROS 2 call."""
        return self.evaluate(context)

    def describe(self):
        return repr(self)

    # The condition as an attribute of an action: `if` or `unless`, the text, and its place.
    def _attribute(self):
        return ('if', self, self._place())

    # None: the launcher asks Python, as for a substitution, and gets true or false.
    def _part(self):
        return None

    # The function of the launch file that _perform() calls; a plan must not call it for an event.
    def _calls(self):
        if getattr(self, '_predicate', None) is not None:
            return name_of_function(self._predicate) or 'a predicate'
        return name_of_function(type(self).evaluate)

    def _perform(self):
        from launch._entities import told_at
        from launch.launch_context import LaunchContext
        with told_at(self):
            return 'true' if self.evaluate(LaunchContext._of_launch()) else 'false'
