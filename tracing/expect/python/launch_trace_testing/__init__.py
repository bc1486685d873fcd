# SPDX-License-Identifier: Apache-2.0
"""
Expectations on traces, for pytest and for anything else that takes an AssertionError.

    from launch_trace_testing import at_least, at_most, event

    def test_ping_pong(traced_launch):
        trace = traced_launch('ping_pong.launch.xml', count=5)
        trace.expect(event('ros2:rcl_publisher_init', topic_name='/ping'), count=1)
        trace.expect_delivered('/ping', at_least(5), latency=at_most(0.005))

The checks and their messages are those of the C++ library of the same name. Durations are seconds.
"""

from launch_trace_testing._engine import (
    Bounds, CallbackRun, Count, Delivery, Event, EventQuery, LaunchRun, Loss, QueryError, RunResult, Trace, TraceError)
from launch_trace_testing._words import around, at_least, at_most, between, event, exactly

__all__ = ['Bounds', 'CallbackRun', 'Count', 'Delivery', 'Event', 'EventQuery', 'LaunchRun', 'Loss', 'QueryError',
           'RunResult', 'Trace', 'TraceError', 'around', 'at_least', 'at_most', 'between', 'event', 'exactly']
