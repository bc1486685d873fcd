# SPDX-License-Identifier: Apache-2.0
"""Results of unittest that know their cases and how long each took."""

import time
import unittest


class _OfAllCases(unittest.TestResult):
    """One outcome for all cases of a run."""

    __test__ = False  # it is no class of tests for pytest

    def _take(self, test_run, add):
        self.testCases = list(test_run.all_cases())
        for case in self.testCases:
            add(case)
            self.testsRun += 1

    @property
    def testTimes(self):  # noqa: N802
        return {case: 0 for case in self.testCases}


class FailResult(_OfAllCases):
    """The launch ended before the tests did. That is no success even without cases."""

    def __init__(self, test_run, message):
        super().__init__()
        self._take(test_run, lambda case: self.failures.append((case, message)))

    def wasSuccessful(self):  # noqa: N802
        return False


class SkipResult(_OfAllCases):
    """The description of the launch asked for no tests."""

    def __init__(self, test_run, skip_reason=''):
        super().__init__()
        self._take(test_run, lambda case: self.addSkip(case, skip_reason))


class TestResult(unittest.TextTestResult):
    """Keeps the cases, and the seconds of each."""

    __test__ = False

    def __init__(self, stream=None, descriptions=None, verbosity=None, **options):
        super().__init__(stream, descriptions, verbosity, **options)
        self._begin = {}
        self._seconds = {}

    @property
    def testCases(self):  # noqa: N802
        return self._seconds.keys()

    @property
    def testTimes(self):  # noqa: N802
        return dict(self._seconds)

    def startTest(self, test):  # noqa: N802
        self._begin[test] = time.monotonic()
        self._seconds[test] = 0
        super().startTest(test)

    def stopTest(self, test):  # noqa: N802
        self._seconds[test] = time.monotonic() - self._begin[test]
        super().stopTest(test)

    def append(self, results):
        """Adds the results of other tests."""
        self._seconds.update(results._seconds)
        self.testsRun += results.testsRun
        for kind in ('failures', 'errors', 'skipped', 'expectedFailures', 'unexpectedSuccesses'):
            getattr(self, kind).extend(getattr(results, kind))
