# SPDX-License-Identifier: Apache-2.0
"""The tests of a module, for programs that run them with LaunchTestRunner."""

import inspect
import unittest

from launch_testing import _loader
from launch_testing.actions import ReadyToTest


class TestRun:
    """A launch with its tests: one of several if generate_test_description() is parametrized."""

    __test__ = False  # it is no class of tests for pytest

    def __init__(self, name, test_description_function, param_args, pre_shutdown_tests, post_shutdown_tests):
        self.name = name
        self.param_args = param_args
        self.pre_shutdown_tests = pre_shutdown_tests
        self.post_shutdown_tests = post_shutdown_tests
        self.timeout = getattr(test_description_function, '__ready_to_test_action_timeout__', 15)
        self._test_description_function = test_description_function
        suffix = self._suffix()
        for case in self.all_cases() if suffix else ():
            method = getattr(case, case._testMethodName)
            case._testMethodName += suffix
            setattr(case, case._testMethodName, method)

    @property
    def markers(self):
        return getattr(self._test_description_function, '__markers__', {})

    def normalized_test_description(self, ready_fn):
        """The launch description and the objects for the tests. `ready_fn` is called when the tests may begin."""
        takes_it = 'ready_fn' in inspect.signature(self._test_description_function).parameters
        ReadyToTest.made.clear()
        result = self._test_description_function(**({'ready_fn': ready_fn} if takes_it else {}))
        description, objects = result if isinstance(result, tuple) else (result, {})
        if not ReadyToTest.made and not takes_it:
            raise _loader.TestFileError('generate_test_description functions must return a LaunchDescription containing a '
                                        'ReadyToTest action',
                                        _loader.place_of_description(self._test_description_function))
        for action in ReadyToTest.made:
            action._add_callback(ready_fn)
        return description, dict(objects)

    def get_launch_description(self):
        """The launch description, to be looked at and not to be launched."""
        return self.normalized_test_description(ready_fn=lambda: None)[0]

    def bind(self, tests, injected_attributes={}, injected_args={}):
        """Gives tests the attributes, and the objects by the names of the arguments of their methods."""
        _loader.bind(tests, injected_attributes, injected_args)

    def all_cases(self):
        yield from _loader.tests_in(self.pre_shutdown_tests)
        yield from _loader.tests_in(self.post_shutdown_tests)

    def __str__(self):
        return self.name + self._suffix()

    def _suffix(self):
        return f"[{', '.join(map(str, self.param_args.values()))}]" if self.param_args else ''


class _Loader(unittest.TestLoader):
    """Loads the tests of one of the two kinds. Each run has classes of its own."""

    def __init__(self, after_shutdown):
        super().__init__()
        self._after_shutdown = after_shutdown

    def loadTestsFromTestCase(self, testCaseClass):  # noqa: N802,N803
        if getattr(testCaseClass, '__post_shutdown_test__', False) != self._after_shutdown:
            return self.suiteClass()
        own = type(testCaseClass.__name__, (testCaseClass,), {'__module__': testCaseClass.__module__})
        return super().loadTestsFromTestCase(own)


def PreShutdownTestLoader():  # noqa: N802  ROS 2's name
    return _Loader(False)


def PostShutdownTestLoader():  # noqa: N802  ROS 2's name
    return _Loader(True)


def LoadTestsFromPythonModule(module, *, name='launch_tests'):  # noqa: N802  ROS 2's name
    """The runs of the module's generate_test_description(), each with the tests of the module."""
    generate = module.generate_test_description
    pairs = generate() if hasattr(generate, '__parametrized__') else [(generate, {})]
    return [TestRun(name, description, arguments, PreShutdownTestLoader().loadTestsFromModule(module),
                    PostShutdownTestLoader().loadTestsFromModule(module)) for description, arguments in pairs]
