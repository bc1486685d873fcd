# SPDX-License-Identifier: Apache-2.0
"""Substitutions. All but the last few are the launcher's own; they are called by the names of XML and YAML files."""

import os

import _launch_engine
from launch import _names
from launch._values import LaunchFileError, WrongKind, items, literal, text
from launch.substitution import Substitution


class SubstitutionFailure(Exception):
    """A substitution that can't be performed. Not caught, it ends the launch with the launcher's own message."""


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


class _Builtin(Substitution):
    """A substitution of the launcher's: its name there, and its arguments, each a text."""

    _call = ''

    def _take(self, *arguments, optional=None):
        """Keeps the arguments, and after them the optional one, unless that is None."""
        if optional is not None:
            arguments = (*arguments, optional)
        self._arguments = [text(argument, f'an argument of {type(self).__name__}') for argument in arguments]

    def _part(self):
        return (self._call, self._arguments)

    def perform(self, context):
        return context._perform(self)


class LaunchConfiguration(_Builtin):
    _call = 'var'

    def __init__(self, variable_name, *, default=None):
        self._take(variable_name, optional=str(default) if isinstance(default, (bool, int, float)) else default)

    @property
    def variable_name(self):
        return self._arguments[0]


class EnvironmentVariable(_Builtin):
    _call = 'env'

    def __init__(self, name, *, default_value=None):
        self._take(name, optional=default_value)


class ThisLaunchFile(_Builtin):
    _call = 'filename'

    def __init__(self):
        self._take()


class ThisLaunchFileDir(_Builtin):
    _call = 'dirname'

    def __init__(self):
        self._take()


class LaunchLogDir(_Builtin):
    _call = 'log_dir'

    def __init__(self):
        self._take()


class FindExecutable(_Builtin):
    _call = 'find-exec'

    def __init__(self, name):
        self._take(name)


class PythonExpression(_Builtin):
    _call = 'eval'

    def __init__(self, expression, python_modules=('math',)):
        modules = [python_modules] if isinstance(python_modules, (str, Substitution)) else (
            items(python_modules, 'python_modules'))
        joined = []
        for module in modules:
            joined += [', ', module] if joined else [module]
        self._take(expression, joined)


class Command(_Builtin):
    _call = 'command'

    def __init__(self, command, *, on_stderr='fail'):
        self._take(command, on_stderr)


class AnonName(_Builtin):
    _call = 'anon'

    def __init__(self, name):
        self._take(name)


class FileContent(_Builtin):
    _call = 'file-content'

    def __init__(self, path):
        self._take(path)


def _operand(value):
    return str(value) if isinstance(value, (bool, int, float)) else value


class NotSubstitution(_Builtin):
    _call = 'not'

    def __init__(self, value):
        self._take(_operand(value))


class AndSubstitution(_Builtin):
    _call = 'and'

    def __init__(self, left, right):
        self._take(_operand(left), _operand(right))


class OrSubstitution(_Builtin):
    _call = 'or'

    def __init__(self, left, right):
        self._take(_operand(left), _operand(right))


class AllSubstitution(_Builtin):
    _call = 'all'

    def __init__(self, *args):
        self._take(*map(_operand, args))


class AnySubstitution(_Builtin):
    _call = 'any'

    def __init__(self, *args):
        self._take(*map(_operand, args))


class EqualsSubstitution(_Builtin):
    _call = 'equals'

    def __init__(self, left, right):
        self._take(_operand(left), _operand(right))


class NotEqualsSubstitution(_Builtin):
    _call = 'not-equals'

    def __init__(self, left, right):
        self._take(_operand(left), _operand(right))


class IfElseSubstitution(_Builtin):
    _call = 'if'

    def __init__(self, condition, if_value='', else_value=''):
        if if_value == '' and else_value == '':
            raise LaunchFileError('IfElseSubstitution needs if_value or else_value')
        self._take(_operand(condition), if_value, else_value)


class ForEachVar(_Builtin):
    _call = 'for-var'

    def __init__(self, name, *, default_value=None):
        self._take(name, optional=default_value)


class ForLoopIndex(_Builtin):
    _call = 'index'

    def __init__(self, name):
        self._take(name)


class BooleanSubstitution(_Builtin):
    """The text as "true" or "false"."""

    _call = 'all'

    def __init__(self, value):
        self._take(_operand(value))


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
        return self._texts

    def _join(self, texts):
        raise NotImplementedError

    def perform(self, context):
        return self._join([context._perform(part) for part in self._texts])


class PathJoinSubstitution(_Joined):
    """A path made of its components; each may be a list of texts to paste together."""

    def _join(self, texts):
        return os.path.join(*texts) if texts else ''

    def __truediv__(self, other):
        return PathSubstitution([self, other])


class PathSubstitution(PathJoinSubstitution):
    """A path that the operator / extends."""

    def __init__(self, path):
        super().__init__(path if isinstance(path, (list, tuple)) else [path])


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
        self._expression = expression
        self._description = description

    def perform(self, context):
        try:
            return str(eval(self._expression, {}, context.get_locals_as_dict()))
        except Exception as error:
            raise SubstitutionFailure(f"'{self._expression}' is not known here: {error}") from error

    def describe(self):
        return f"LocalVar('{self._description or self._expression}')"


_names.same_module(__name__, __name__ + '.this_launch_file')
_names.one_class_modules(__name__)
del _launch_engine
