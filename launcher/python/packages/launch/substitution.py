# SPDX-License-Identifier: Apache-2.0
"""Substitution: a text that is known only when it is visited."""

from launch._places import Located, of_function


class Substitution(Located):
    """A base class for the substitutions of launch files: perform() returns the text, describe() describes it."""

    def perform(self, context):
        raise NotImplementedError(f'{type(self).__name__} has no perform()')

    def describe(self):
        return f'{type(self).__name__}()'

    # The launcher's own substitutions return their name and their arguments. None: Python performs it.
    def _part(self):
        return None

    # A plan performs substitutions also for an event: they are values.
    def _calls(self):
        return None

    def _perform(self):
        from launch.launch_context import LaunchContext
        from launch._entities import told_at
        from launch._values import WrongKind
        with told_at(self):
            result = self.perform(LaunchContext._of_launch())
            if not isinstance(result, str):
                raise WrongKind(f'{type(self).__name__}.perform() must return a str, got {type(result).__name__}',
                                '', of_function(type(self).perform))
        return result
