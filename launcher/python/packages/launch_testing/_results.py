# SPDX-License-Identifier: Apache-2.0
"""Results of tests, as data."""

import sys
import time
import unittest


class Result(unittest.TextTestResult):
    """Prints as unittest does, and keeps a dict for each test: name, class, seconds, outcome, message."""

    def __init__(self, *args, **kwargs):
        super().__init__(*args, **kwargs)
        self.cases = []
        self._begin = {}

    def startTest(self, test):  # noqa: N802
        self._begin[test.id()] = time.monotonic()
        super().startTest(test)

    def _keep(self, test, outcome, message=''):
        seconds = time.monotonic() - self._begin.get(test.id(), time.monotonic())
        self.cases.append({'name': getattr(test, '_testMethodName', str(test)), 'class': type(test).__name__,
                           'seconds': round(seconds, 3), 'outcome': outcome, 'message': message})

    def addSuccess(self, test):  # noqa: N802
        super().addSuccess(test)
        self._keep(test, 'passed')

    def addFailure(self, test, err):  # noqa: N802
        super().addFailure(test, err)
        self._keep(test, 'failure', self.failures[-1][1])

    def addError(self, test, err):  # noqa: N802
        super().addError(test, err)
        self._keep(test, 'error', self.errors[-1][1])

    def addSkip(self, test, reason):  # noqa: N802
        super().addSkip(test, reason)
        self._keep(test, 'skipped', reason)

    def addExpectedFailure(self, test, err):  # noqa: N802
        super().addExpectedFailure(test, err)
        self._keep(test, 'passed')

    def addUnexpectedSuccess(self, test):  # noqa: N802
        super().addUnexpectedSuccess(test)
        self._keep(test, 'failure', 'the test was expected to fail, and has passed')

    def addSubTest(self, test, subtest, err):  # noqa: N802
        super().addSubTest(test, subtest, err)
        if err is not None:
            is_failure = issubclass(err[0], test.failureException)
            kept = self.failures if is_failure else self.errors
            self._keep(test, 'failure' if is_failure else 'error', f'{subtest}\n{kept[-1][1]}')


def run(suite):
    """Runs the tests and returns the dicts."""
    if suite.countTestCases() == 0:
        return []
    return unittest.TextTestRunner(stream=sys.stderr, verbosity=2, resultclass=Result).run(suite).cases
