# SPDX-License-Identifier: Apache-2.0
"""Decorators of generate_test_description() and of classes of tests."""

import functools


def post_shutdown_test():
    """The tests of the class run when all processes have ended."""

    def decorate(test_class):
        test_class.__post_shutdown_test__ = True
        return test_class

    return decorate


def parametrize(argnames, argvalues):
    """The system is launched and tested once for each value, or tuple of values, of the named arguments."""
    names = [name.strip() for name in argnames.split(',') if name.strip()]

    def decorate(function):
        @functools.wraps(function)
        def each():
            for values in argvalues:
                arguments = dict(zip(names, values if isinstance(values, tuple) else (values,)))
                yield functools.update_wrapper(functools.partial(function, **arguments), function), arguments

        each.__parametrized__ = True
        return each

    return decorate


def ready_to_test_action_timeout(timeout):
    """How many seconds the tests wait for ReadyToTest."""

    def decorate(function):
        function.__ready_to_test_action_timeout__ = timeout
        return function

    return decorate
