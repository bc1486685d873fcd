# SPDX-License-Identifier: Apache-2.0
"""Ping and pong, tested by what their trace holds. ping_pong_test.cpp is the same in C++."""

from pathlib import Path

from launch_trace_testing import at_least, at_most, event

PING_PONG = Path(__file__).parent.parent / '01_ping_pong.launch.xml'


def test_answers_each_message(traced_launch):
    trace = traced_launch(PING_PONG, count=10, period_ms=20)

    trace.expect_processes(['ping', 'pong'])
    trace.expect(event('ros2:rcl_publisher_init', topic_name='/ping'), 1)
    trace.expect(event('ros2:rcl_publisher_init', where='queue_depth > 0'))
    trace.expect_field(event('ros2:rcl_node_init'), 'node_handle', 'handle')
    trace.expect_none(event('ros2:rcl_lifecycle_transition'))

    timer = trace.first(event('ros2:rcl_timer_init', process='ping'))
    assert timer['period'] == 20_000_000
    added = trace.first(event('ros2:rclcpp_timer_callback_added', timer_handle=timer['timer_handle']))
    trace.expect(event('ros2:callback_start', process='ping', callback=added['callback']), at_least(10))

    trace.expect_order([event(f'ros2:{name}', process='ping') for name in ('rcl_init', 'rcl_node_init', 'callback_start')])
    answers = trace.first(event('ros2:rcl_publisher_init', topic_name='/pong'))
    trace.expect_happens_before(
        event('ros2:rcl_timer_init', process='ping'),
        event('ros2:rcl_publish', process='pong', publisher_handle=answers['publisher_handle']))

    trace.expect_delivered('/ping', at_least(10), at_most(5), publisher='/ping', subscriber='/pong')
    trace.expect_delivered('/pong', at_least(10))
    trace.expect_callback_period(at_most(5), node='/ping', timers_only=True)
    trace.expect_callback_duration(at_most(5), node='/pong', topic='/ping')
