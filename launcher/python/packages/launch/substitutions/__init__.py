# SPDX-License-Identifier: Apache-2.0
"""Substitutions. Most are the launcher's own; they are called by the names of XML and YAML files."""

from collections.abc import Iterable

from launch import _names
from launch._values import LaunchFileError, items, text
from launch.substitution import Substitution
from launch.substitutions._builtin import (
    _AllArguments, _Argument, _Builtin, SubstitutionFailure, TextSubstitution, described, parts_of)
from launch.substitutions._joined import (
    ExtendedBySlash, LocalSubstitution, PathJoinSubstitution, PathSubstitution, StringJoinSubstitution)


class LaunchConfiguration(_Builtin):
    _call = 'var'
    variable_name = _Argument(0)

    def __init__(self, variable_name, *, default=None):
        # ROS 2 takes any value here and makes a text of it; a mapping that is empty is an empty text.
        if default is not None and not isinstance(default, (str, Substitution)):
            parts = items(default, 'default') if isinstance(default, Iterable) else [default]
            default = [part if isinstance(part, (str, Substitution)) else str(part) for part in parts]
        self._take(variable_name, optional=default)

    def describe(self):
        return f'LaunchConfig({described(self._arguments[0])})'


class EnvironmentVariable(_Builtin):
    _call = 'env'
    _described = 'EnvVar'
    name = _Argument(0)
    default_value = _Argument(1)

    def __init__(self, name, *, default_value=None):
        self._take(name, optional=default_value)


class ThisLaunchFile(_Builtin):
    _call = 'filename'

    def __init__(self):
        self._take()


class ThisLaunchFileDir(ExtendedBySlash, _Builtin):
    _call = 'dirname'

    def __init__(self):
        self._take()


class LaunchLogDir(ExtendedBySlash, _Builtin):
    _call = 'log_dir'

    def __init__(self):
        self._take()


class FindExecutable(ExtendedBySlash, _Builtin):
    _call = 'find-exec'
    _described = 'FindExec'
    name = _Argument(0)

    def __init__(self, name):
        self._take(name)


class PythonExpression(_Builtin):
    _call = 'eval'
    expression = _Argument(0)

    def __init__(self, expression, python_modules=('math',)):
        modules = [python_modules] if isinstance(python_modules, (str, Substitution)) else (
            items(python_modules, 'python_modules'))
        joined = []
        for module in modules:
            joined += [', ', module] if joined else [module]
        self._take(expression, joined)
        self._modules = modules

    @property
    def python_modules(self):
        return [parts_of(text(module, 'python_modules')) for module in self._modules]

    def describe(self):
        modules = ', '.join(described(text(module, 'python_modules')) for module in self._modules)
        return f'PythonExpr({described(self._arguments[0])}, [{modules}])'


class Command(_Builtin):
    _call = 'command'
    command = _Argument(0)
    on_stderr = _Argument(1)

    def describe(self):
        return f'Command({described(self._arguments[0])})'

    def __init__(self, command, *, on_stderr='fail'):
        self._take(command, on_stderr)


class AnonName(_Builtin):
    _call = 'anon'
    name = _Argument(0)

    def __init__(self, name):
        self._take(name)


class FileContent(_Builtin):
    _call = 'file-content'
    path = _Argument(0)

    def __init__(self, path):
        self._take(path)


def _operand(value):
    return str(value) if isinstance(value, (bool, int, float)) else value


class NotSubstitution(_Builtin):
    _call = 'not'
    value = _Argument(0)

    def __init__(self, value):
        self._take(_operand(value))


class AndSubstitution(_Builtin):
    _call = 'and'
    left = _Argument(0)
    right = _Argument(1)

    def __init__(self, left, right):
        self._take(_operand(left), _operand(right))


class OrSubstitution(_Builtin):
    _call = 'or'
    left = _Argument(0)
    right = _Argument(1)

    def __init__(self, left, right):
        self._take(_operand(left), _operand(right))


class AllSubstitution(_Builtin):
    _call = 'all'
    args = _AllArguments()

    def __init__(self, *args):
        self._take(*map(_operand, args))


class AnySubstitution(_Builtin):
    _call = 'any'
    args = _AllArguments()

    def __init__(self, *args):
        self._take(*map(_operand, args))


class EqualsSubstitution(_Builtin):
    _call = 'equals'
    left = _Argument(0)
    right = _Argument(1)

    def __init__(self, left, right):
        self._take(_operand(left), _operand(right))


class NotEqualsSubstitution(_Builtin):
    _call = 'not-equals'
    left = _Argument(0)
    right = _Argument(1)

    def __init__(self, left, right):
        self._take(_operand(left), _operand(right))


class IfElseSubstitution(_Builtin):
    _call = 'if'
    condition = _Argument(0)
    if_value = _Argument(1)
    else_value = _Argument(2)

    def __init__(self, condition, if_value='', else_value=''):
        if if_value == '' and else_value == '':
            raise LaunchFileError('IfElseSubstitution needs if_value or else_value')
        self._take(_operand(condition), if_value, else_value)


class ForEachVar(_Builtin):
    _call = 'for-var'
    name = _Argument(0)
    default_value = _Argument(1)

    def __init__(self, name, *, default_value=None):
        self._take(name, optional=default_value)


class ForLoopIndex(_Builtin):
    _call = 'index'
    name = _Argument(0)

    def __init__(self, name):
        self._take(name)


class BooleanSubstitution(_Builtin):
    """The text as "true" or "false"."""

    _call = 'all'
    value = _Argument(0)

    def __init__(self, value):
        self._take(_operand(value))


_names.same_module(__name__, __name__ + '.this_launch_file', __name__ + '.for_loop_var')
_names.one_class_modules(__name__)
