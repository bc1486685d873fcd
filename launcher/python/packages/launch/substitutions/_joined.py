# SPDX-License-Identifier: Apache-2.0
"""Substitutions that Python performs itself."""

import os

from launch._values import WrongKind, items, literal, text
from launch.substitution import Substitution
from launch.substitutions._builtin import SubstitutionFailure, described, parts_of


class _Joined(Substitution):
    """Texts that Python joins into one."""

    def __init__(self, substitutions):
        if isinstance(substitutions, (str, Substitution)):
            substitutions = [substitutions]
        if isinstance(substitutions, (set, frozenset)):
            raise WrongKind(f'the parts of {type(self).__name__} must be a list, a set has no order')
        self._texts = [text(part, f'a part of {type(self).__name__}')
                       for part in items(substitutions, f'the parts of {type(self).__name__}')]

    @property
    def substitutions(self):
        return [parts_of(part) for part in self._texts]

    def describe(self):
        return f'{type(self).__name__}({", ".join(map(described, self._texts))})'

    def _join(self, texts):
        raise NotImplementedError

    def perform(self, context):
        return self._join([context._perform(part) for part in self._texts])


class PathJoinSubstitution(_Joined):
    """A path made of its components; each may be a list of texts to paste together."""

    @property
    def substitutions(self):
        # Single components were no lists before components could have several parts.
        return [parts[0] if len(parts) == 1 else parts for parts in super().substitutions]

    def describe(self):
        return "PathJoin('" + ' + '.join(map(described, self._texts)) + "')"

    def _join(self, texts):
        return os.path.join(*texts) if texts else ''

    def __truediv__(self, other):
        return PathJoinSubstitution([*self._texts, other])


class ExtendedBySlash:
    """A mixin for substitutions that are one path."""

    def __truediv__(self, other):
        return PathJoinSubstitution([self, other])


class PathSubstitution(PathJoinSubstitution):
    """A path that the operator / extends."""

    def __init__(self, path):
        super().__init__([path])


class StringJoinSubstitution(_Joined):

    def __init__(self, substitutions, delimiter=''):
        super().__init__(substitutions)
        self._delimiter = text(delimiter, 'delimiter')

    def perform(self, context):
        return context._perform(self._delimiter).join(context._perform(part) for part in self._texts)


class LocalSubstitution(Substitution):
    """A value of the event that is being handled: LocalSubstitution('event.returncode')."""

    def __init__(self, expression, description=None):
        literal(expression, 'expression')
        self.expression = expression
        self.description = description

    def perform(self, context):
        try:
            return str(eval(self.expression, {}, context.get_locals_as_dict()))
        except Exception as error:
            raise SubstitutionFailure(f"'{self.expression}' is not known here: {error}") from error

    def describe(self):
        return f"LocalVar('{self.description or self.expression}')"
