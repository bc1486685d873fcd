# SPDX-License-Identifier: Apache-2.0
"""
What substitutions and simple actions do where the launcher can't be asked: in a Python program without a launch, as in a test of a
package, and on the thread of the tests of launch_test.

Everywhere else the launcher performs them.
"""

import math
import os
import shlex
import shutil
import subprocess

import _launch_engine
from launch.substitution import Substitution

_TRUTH = {'true': True, '1': True, 'false': False, '0': False}


def is_here():
    """Whether the launcher can't be asked: in a program without a launch, and in the launcher on the thread of tests."""
    if hasattr(_launch_engine, 'IS_PROGRAM'):
        return not _launch_engine.has_launch()  # the launch of a program may be asked by any thread
    return not _launch_engine.is_running()


def perform(value, context):
    """The text of a text, of a substitution, or of a list of these that are pasted together."""
    if isinstance(value, str):
        return value
    if not isinstance(value, Substitution):
        return ''.join(perform(part, context) for part in value)
    part = value._part()
    if part is None:
        return value.perform(context)
    if isinstance(part, str):
        return part
    call, arguments = part
    if call not in _SUBSTITUTIONS:
        raise _failure(f'{type(value).__name__} has a value only while a launch runs')
    return _SUBSTITUTIONS[call](context, [_Argument(argument, context) for argument in arguments])


class _Argument:
    """An argument, which is performed when its text is needed: a default may have no value."""

    def __init__(self, value, context):
        self._value = value
        self._context = context

    @property
    def text(self):
        return perform(self._value, self._context)

    @property
    def truth(self):
        text = self.text.strip().lower()
        if text not in _TRUTH:
            raise _failure(f"'{self.text}' is no boolean, expected true, false, 1 or 0")
        return _TRUTH[text]


def _failure(message):
    from launch.substitutions import SubstitutionFailure
    return SubstitutionFailure(message)


def _bool(value):
    return 'true' if value else 'false'


def _value_of(variables, what):
    def perform_it(context, arguments):
        name = arguments[0].text
        values = variables(context)
        if name in values:
            return str(values[name])
        if len(arguments) > 1:
            return arguments[1].text
        raise _failure(f"{what} '{name}' does not exist")
    return perform_it


def _evaluate(_context, arguments):
    expression = arguments[0].text
    names = {}
    try:
        for name in filter(None, (arguments[1].text if len(arguments) > 1 else 'math').replace(' ', '').split(',')):
            module = __import__(name)
            names[name.split('.')[0]] = module
            if name == 'math':
                names.update(vars(math))
        return str(eval(expression, {}, names))
    except Exception as error:
        raise _failure(f"failed to evaluate the Python expression '{expression}': {type(error).__name__}: {error}") from error


def _command(_context, arguments):
    line = arguments[0].text
    on_stderr = arguments[1].text if len(arguments) > 1 else 'fail'
    try:
        done = subprocess.run(shlex.split(line), text=True, check=False, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT if on_stderr == 'capture' else subprocess.PIPE)
    except (OSError, ValueError) as error:
        raise _failure(f"executing command '{line}' failed: {error}") from error
    if done.returncode != 0:
        raise _failure(f"executing command '{line}' failed: exit code {done.returncode}")
    if done.stderr and on_stderr == 'fail':
        raise _failure(f"executing command '{line}' failed: it wrote to standard error")
    return done.stdout


def _find_executable(_context, arguments):
    name = arguments[0].text
    path = shutil.which(name)
    if path is None:
        raise _failure(f"executable '{name}' not found on the PATH")
    return path


def _file_content(_context, arguments):
    path = arguments[0].text
    try:
        with open(path, encoding='utf-8') as file:
            return file.read()
    except OSError as error:
        raise _failure(f"file not found: '{path}'") from error


def _package_prefix(name):
    from ament_index_python.packages import PackageNotFoundError, get_package_prefix
    try:
        return get_package_prefix(name)
    except PackageNotFoundError as error:
        raise _failure(str(error)) from error


def _executable_in_package(_context, arguments):
    executable, package = arguments[0].text, arguments[1].text
    path = os.path.join(_package_prefix(package), 'lib', package, executable)
    if not os.access(path, os.X_OK):
        raise _failure(f"executable '{executable}' not found in package '{package}'")
    return path


def _are_equal(one, other):
    if one.strip().lower() in _TRUTH and other.strip().lower() in _TRUTH:
        return _TRUTH[one.strip().lower()] == _TRUTH[other.strip().lower()]
    try:
        return math.isclose(float(one), float(other))
    except ValueError:
        return one == other


def _if(_context, arguments):
    if arguments[0].truth:
        return arguments[1].text
    return arguments[2].text if len(arguments) > 2 else ''


def _all(_context, arguments):
    return _bool(all([argument.truth for argument in arguments]))


def _any(_context, arguments):
    return _bool(any([argument.truth for argument in arguments]))


# By the launcher's names. What is missing, such as the launch file, is only there while a launch runs.
_SUBSTITUTIONS = {
    'var': _value_of(lambda context: context.launch_configurations, 'launch configuration'),
    'env': _value_of(lambda context: os.environ, 'environment variable'),
    'param': _value_of(lambda context: {}, 'parameter'),
    'eval': _evaluate, 'command': _command, 'find-exec': _find_executable, 'file-content': _file_content,
    'find-pkg-prefix': lambda context, arguments: _package_prefix(arguments[0].text),
    'find-pkg-share': lambda context, arguments: os.path.join(_package_prefix(arguments[0].text), 'share', arguments[0].text),
    'exec-in-pkg': _executable_in_package,
    'not': lambda context, arguments: _bool(not arguments[0].truth),
    'and': _all, 'all': _all, 'or': _any, 'any': _any,
    'equals': lambda context, arguments: _bool(_are_equal(arguments[0].text, arguments[1].text)),
    'not-equals': lambda context, arguments: _bool(not _are_equal(arguments[0].text, arguments[1].text)),
    'if': _if,
}


def execute(action, context):
    """Carries out an action that changes the context alone. Whether it is one."""
    done = False
    for tag, _place, attributes, *_rest in action._tags():
        if tag not in _ACTIONS:
            return done
        values = {name: perform(value, context) for name, value, *_ in attributes
                  if name in ('name', 'value', 'default') and value is not None}
        _ACTIONS[tag](context, **values)
        done = True
    return done


def _declare(context, name, default=None):
    if name in context.launch_configurations:
        return
    if default is None:
        raise RuntimeError(f"Required launch argument '{name}' was not provided")
    context.launch_configurations[name] = default


_ACTIONS = {
    'arg': _declare, 'bool_arg': _declare,
    'let': lambda context, name, value: context.launch_configurations.__setitem__(name, value),
    'unset': lambda context, name: context.launch_configurations.pop(name, None),
    'set_env': lambda context, name, value: os.environ.__setitem__(name, value),
    'unset_env': lambda context, name: os.environ.pop(name, None),
}
