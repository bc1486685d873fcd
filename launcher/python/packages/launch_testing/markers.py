# SPDX-License-Identifier: Apache-2.0
"""Marks of test descriptions and of tests."""

import functools
import time


def keep_alive(test_description):
    """The tests go on when all processes have ended."""
    markers = getattr(test_description, '__markers__', {})
    test_description.__markers__ = {**markers, 'keep_alive': True}
    return test_description


def retry_on_failure(*, times, delay=None):
    """Repeats a test until one of `times` tries does not fail an assertion; `delay` seconds are between them."""
    if times <= 0:
        raise ValueError('times must be positive')

    def decorate(test):
        @functools.wraps(test)
        def tried(self, *args, **kwargs):
            for _ in range(times - 1):
                try:
                    return test(self, *args, **kwargs)
                except AssertionError:
                    if delay is not None:
                        time.sleep(delay)
            return test(self, *args, **kwargs)

        return tried

    return decorate
