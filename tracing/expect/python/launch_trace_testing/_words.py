# SPDX-License-Identifier: Apache-2.0
"""The words of expectations: which events, how many, how long."""

from launch_trace_testing._engine import Bounds, Count, EventQuery


def event(name, where=None, process=None, **fields):
    """
    The events of this name, or of this pattern with * and ?.

    `where` is a condition as of `launch trace read --where`, `process` a name or an id, and each further argument a
    field with its value. The methods of the query add more conditions.
    """
    query = EventQuery(name)
    for field, value in fields.items():
        query.with_field(field, value)
    if where is not None:
        query.where(where)
    if process is not None:
        query.in_process(process)
    return query


class _Limit:
    """A limit of a number of events, or of a duration, whichever is asked for."""

    def __init__(self, least, most, share):
        self.least = least
        self.most = most
        self.share = share

    def count(self):
        for limit in (self.least, self.most):
            if limit is not None and int(limit) != limit:
                raise TypeError(f'{limit} is no number of events')
        return Count(int(self.least or 0), None if self.most is None else int(self.most))

    def bounds(self):
        return Bounds(float(self.least or 0), None if self.most is None else float(self.most), float(self.share))


def exactly(count):
    return _Limit(count, count, 1)


def at_least(limit, share=1):
    """At least so many, or so many seconds for this share of the durations."""
    return _Limit(limit, None, share)


def at_most(limit, share=1):
    """At most so many, or so many seconds for this share of the durations."""
    return _Limit(None, limit, share)


def between(least, most, share=1):
    return _Limit(least, most, share)


def around(expected, tolerance, share=1):
    """A duration in seconds with a tolerance, for this share of the durations."""
    return _Limit(expected - tolerance, expected + tolerance, share)
