# SPDX-License-Identifier: Apache-2.0
"""What the substitutions are made of: literal text, and calls of the launcher's own substitutions."""

from launch._values import WrongKind, literal, text
from launch.substitution import Substitution


class SubstitutionFailure(Exception):
    """A substitution that can't be performed. Not caught, it ends the launch with the launcher's own message."""

    def __init__(self, msg=''):
        super().__init__(msg)


class TextSubstitution(Substitution):

    def __init__(self, *, text):
        if not isinstance(text, str):
            raise WrongKind(f'text of TextSubstitution must be a str, got {type(text).__name__}', f"write '{text}'")
        self.text, = literal(text, 'text of TextSubstitution')

    def perform(self, context):
        return self.text

    def describe(self):
        return f"'{self.text}'"

    def _part(self):
        return self.text


class _Argument:
    """An argument of a substitution, as the list of substitutions that ROS 2 makes of it; None when it is not given."""

    def __init__(self, index):
        self._index = index

    def __get__(self, substitution, _owner=None):
        if substitution is None:
            return self
        arguments = substitution._arguments
        return parts_of(arguments[self._index]) if self._index < len(arguments) else None


class _AllArguments:

    def __get__(self, substitution, _owner=None):
        return self if substitution is None else [parts_of(argument) for argument in substitution._arguments]


def parts_of(given):
    """The substitutions that a text is pasted together from."""
    return [part if isinstance(part, Substitution) else TextSubstitution(text=part) for part in given]


def described(given):
    return ' + '.join(part.describe() for part in parts_of(given))


class _Builtin(Substitution):
    """A substitution of the launcher's: its name there, and its arguments, each a text."""

    _call = ''
    _described = None  # the name in descriptions; None: that of the class

    def _take(self, *arguments, optional=None):
        """Keeps the arguments, and after them the optional one, unless that is None."""
        if optional is not None:
            arguments = (*arguments, optional)
        self._arguments = [text(argument, f'an argument of {type(self).__name__}') for argument in arguments]

    def _part(self):
        return (self._call, self._arguments)

    def describe(self):
        return f'{self._described or type(self).__name__}({", ".join(map(described, self._arguments))})'

    def perform(self, context):
        return context._perform(self)
