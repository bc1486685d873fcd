# SPDX-License-Identifier: Apache-2.0
"""The tests of a file, and what they are given."""

import functools
import importlib.util
import inspect
import os
import sys
import types
import unittest

from launch._places import note_source, of_function
from launch._values import LaunchFileError
from launch_testing.actions import ReadyToTest


class TestFileError(LaunchFileError):
    """The file is no file of launch tests. `place` is where it says so, if that is known."""

    def __init__(self, message, place=None):
        super().__init__(message)
        self.of_element = place


def place_of_description(function):
    """Of a generate_test_description(), also of one with parameters."""
    return of_function(inspect.unwrap(getattr(function, 'func', function)))


def _stand_in_for_pytest():
    """Files of tests mark generate_test_description() with pytest, which need not be installed for that."""
    if importlib.util.find_spec('pytest') is not None:
        return

    class Marks:
        def __getattr__(self, _name):
            return self._mark

        @staticmethod
        def _mark(*arguments, **_options):
            if len(arguments) == 1 and callable(arguments[0]):
                return arguments[0]
            return lambda decorated: decorated

    module = types.ModuleType('pytest')
    module.mark = Marks()
    sys.modules['pytest'] = module


def load_module(path, name):
    """Runs the file, as a module that test classes and their methods belong to."""
    _stand_in_for_pytest()
    with open(path, encoding='utf-8') as file:
        source = file.read()
    note_source(path, source)
    module = types.ModuleType(name)
    module.__file__ = path
    sys.modules[name] = module
    sys.path.insert(0, os.path.dirname(path))
    exec(compile(source, path, 'exec', dont_inherit=True), module.__dict__)
    if not callable(getattr(module, 'generate_test_description', None)):
        raise TestFileError(f"'{path}' has no generate_test_description(), which returns a LaunchDescription", (path, 1, 0, 0))
    return module


class TestRun:
    """A launch with its tests: one of several if generate_test_description() is parametrized."""

    def __init__(self, module, description, arguments):
        self.arguments = arguments
        self.description = description
        self.name_suffix = f'[{", ".join(map(str, arguments.values()))}]' if arguments else ''
        self.keep_alive = getattr(description, '__markers__', {}).get('keep_alive', False)
        self.ready_timeout = getattr(description, '__ready_to_test_action_timeout__', 15)
        self.active = unittest.TestSuite()
        self.post_shutdown = unittest.TestSuite()
        for test in tests_in(unittest.defaultTestLoader.loadTestsFromModule(module)):
            after = getattr(type(test), '__post_shutdown_test__', False)
            (self.post_shutdown if after else self.active).addTest(test)

    def launch_description(self, ready):
        """The launch description and the objects for the tests; `ready` is called when the tests may begin."""
        ReadyToTest.made.clear()
        takes_ready = 'ready_fn' in inspect.signature(self.description).parameters
        result = self.description(**({'ready_fn': ready} if takes_ready else {}))
        description, objects = result if isinstance(result, tuple) else (result, {})
        if not takes_ready:
            if not ReadyToTest.made:
                raise TestFileError('generate_test_description functions must return a LaunchDescription containing a '
                                    'ReadyToTest action', place_of_description(self.description))
            for action in ReadyToTest.made:
                action._add_callback(ready)
        return description, dict(objects)


def runs_of(module):
    generate = module.generate_test_description
    pairs = list(generate()) if hasattr(generate, '__parametrized__') else [(generate, {})]
    if not pairs:
        raise TestFileError(f"'{module.__file__}' has no test runs: its parametrize() has no values", place_of_description(generate))
    return [TestRun(module, description, arguments) for description, arguments in pairs]


def tests_in(suite):
    if not isinstance(suite, (unittest.TestSuite, list, tuple)):
        yield suite
        return
    for part in suite:
        yield from tests_in(part)


def bind(suite, attributes, objects):
    """Gives tests the attributes, and the objects by the names of the arguments of their methods."""
    for test in tests_in(suite):
        if not hasattr(test, '_testMethodName') or isinstance(test, unittest.loader._FailedTest):
            continue
        for name in (test._testMethodName, 'setUp', 'tearDown'):
            setattr(test, name, _with_objects(getattr(test, name), objects))
        for name, value in attributes.items():
            setattr(type(test), name, value)
    for test_class in {type(test) for test in tests_in(suite)}:
        for name in ('setUpClass', 'tearDownClass'):
            setattr(test_class, name, _with_objects(getattr(test_class, name), objects))


def _with_objects(function, objects):
    wanted = inspect.signature(function).parameters
    return functools.partial(function, **{name: value for name, value in objects.items() if name in wanted})
