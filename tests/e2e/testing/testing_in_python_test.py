# SPDX-License-Identifier: Apache-2.0
"""The Python module launch_trace_testing, on the example system of tests/support/trace_writer/example_system.hpp."""

import os
import subprocess
import tempfile
import unittest

from launch_trace_testing import (
    LaunchRun, QueryError, Trace, TraceError, around, at_least, at_most, between, event, exactly)


class Expectations(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as directory:
            subprocess.run([os.environ['WRITE_EXAMPLE_TRACE'], directory + '/trace', '20'], check=True,
                           stdout=subprocess.DEVNULL)
            cls.trace = Trace(directory)

    def failure(self, expectation, *arguments, **named):
        with self.assertRaises(AssertionError) as caught:
            expectation(*arguments, **named)
        return str(caught.exception)

    def test_events_have_fields(self):
        init = self.trace.first(event('ros2:rcl_publisher_init', topic_name='/scan'))
        self.assertEqual(init['queue_depth'], 10)
        self.assertEqual(init['topic_name'], '/scan')
        self.assertEqual(init.keys(),
                         ['publisher_handle', 'node_handle', 'rmw_publisher_handle', 'topic_name', 'queue_depth'])
        self.assertEqual((init.name, init.vpid, init.vtid, init.procname), ('ros2:rcl_publisher_init', 101, 101, 'sensor'))
        self.assertIn('queue_depth', init)
        self.assertIsNone(init.get('depth'))
        with self.assertRaisesRegex(KeyError, "ros2:rcl_publisher_init has no field 'depth'; it has publisher_handle"):
            init['depth']
        self.assertIs(type(self.trace[0].time_ns), int)
        self.assertEqual(len(list(self.trace)), len(self.trace))
        self.assertEqual(self.trace.first(event('ros2:rmw_publisher_init'))['gid'], (0,) * 16)
        self.assertIsNone(self.trace.first(event('ros2:nothing')))

    def test_numbers_of_events(self):
        self.assertEqual(len(self.trace.expect(event('ros2:callback_start', process='sensor'), 20)), 20)
        self.trace.expect(event('ros2:callback_start', process='sensor'))
        for count in (exactly(60), at_least(60), at_most(60), between(60, 61)):
            self.trace.expect(event('ros2:callback_start'), count)
        self.trace.expect(event('ros2:rcl_publisher_init', where='queue_depth > 5 && topic_name =~ "^/s"'), 1)
        self.trace.expect(event('ros2:rcl_take').that('is of the filter', lambda each: each.vpid == 102), 20)
        self.trace.expect_none(event('ros2:rcl_client_init'))
        self.assertEqual(self.failure(self.trace.expect, event('ros2:rcl_publisher_init', topic_name='/scam')), '''\
expected: at least 1 'ros2:rcl_publisher_init' with topic_name = "/scam"
     saw: none of 575 events
nearest events:
  +0.000111000  sensor[101]  ros2:rcl_publisher_init  topic_name="/scan" publisher_handle=0x103 node_handle=0x101 ...
  +0.001111000  filter[102]  ros2:rcl_publisher_init  topic_name="/points" publisher_handle=0x103 node_handle=0x101 ...''')

    def test_fields_names_and_processes(self):
        self.trace.expect_each(event('ros2:rcl_publisher_init'), event('', queue_depth=10))
        self.trace.expect_field(event('ros2:rcl_node_init'), 'node_handle', 'handle')
        self.trace.expect_field(event('ros2:rmw_publisher_init'), 'gid', 'array', 16)
        with self.assertRaisesRegex(ValueError, "'hadle' is no kind of field; there are 'array', 'handle', 'integer'"):
            self.trace.expect_field(event('ros2:rcl_node_init'), 'node_handle', 'hadle')
        self.trace.expect_names(['ros2:callback_start', 'ros2:callback_end'], among='ros2:callback_*')
        self.trace.expect_processes(['sensor', 'filter', 'display'])
        publish = self.trace.first(event('ros2:rmw_publish'))
        self.trace.expect_matching_field(publish, 'timestamp', event('ros2:rmw_take').after(publish), 'source_timestamp')

    def test_order_and_causes(self):
        self.trace.expect_order([event('ros2:rcl_init'), event('ros2:rcl_node_init'), event('ros2:callback_start')])
        self.trace.expect_sorted(self.trace.select(event('ros2:callback_start')))
        self.trace.expect_happens_before(event('ros2:rcl_timer_init'), event('ros2:callback_start', process='display'))
        self.assertTrue(self.failure(self.trace.expect_happens_before, event('ros2:rcl_init', process='display'),
                                     event('ros2:callback_start', process='sensor')).startswith(
            "expected: each 'ros2:callback_start' in process 'sensor' follows from 'ros2:rcl_init' in process 'display'\n"
            '     saw: 20 of 20 effects without a way from any cause, by thread, message or request\n'))

    def test_durations(self):
        self.trace.expect_delivered('/scan', 20, at_most(0.000205), publisher='/sensor', subscriber='/filter')
        self.trace.expect_all_delivered('/points')
        self.trace.expect_callback_duration(at_most(0.001, share=0.95), node='/filter', topic='/scan')
        self.trace.expect_callback_period(around(0.01, 0.001), timers_only=True)
        self.trace.expect_period(event('ros2:rcl_publish', process='sensor'), around(0.01, 0.001))
        self.trace.expect_duration(event('ros2:callback_start', process='sensor'), event('ros2:callback_end'),
                                   around(0.0002, 0.00001))
        self.trace.expect_no_loss()
        self.assertEqual(self.failure(self.trace.expect_callback_duration, at_most(0.001), node='/filter'), '''\
expected: each callback of node '/filter' takes at most 1.000 ms
     saw: 1 of 20 outside; least 0.400 ms, median 0.400 ms, most 4.000 ms
worst:
  +0.211301000      4.000 ms  /filter topic /scan Filter::on_scan(sensor_msgs::msg::LaserScan const&)''')

    def test_what_the_trace_means(self):
        delivery = next(each for each in self.trace.deliveries if each.topic == '/scan')
        self.assertEqual((delivery.publisher, delivery.subscriber), ('/sensor', '/filter'))
        self.assertEqual(delivery.callback_start_ns - delivery.published_ns, 200_000)
        self.assertEqual({run.node for run in self.trace.callbacks}, {'/sensor', '/filter', '/display'})

    def test_mistakes(self):
        with self.assertRaises(QueryError) as caught:
            event('ros2:rcl_take', where='message = 3')
        self.assertEqual(str(caught.exception),
                         "the condition is wrong: expected '==' to compare\n  message = 3\n          ^")
        with self.assertRaisesRegex(TypeError, 'a field is an int, a float, a str, or a list or tuple of these, not set'):
            event('ros2:rcl_take', message={1})
        with self.assertRaisesRegex(TypeError, '1.5 is no number of events'):
            self.trace.expect(event('ros2:rcl_take'), at_least(1.5))
        with self.assertRaisesRegex(TraceError, "cannot read the trace '/nonexistent': no such directory"):
            Trace('/nonexistent')


class Runs(unittest.TestCase):

    def test_a_program(self):
        run = LaunchRun(programs=[['echo', 'here I am']], events=[])
        self.assertTrue(run.wait_for_output('here I am'))
        result = run.wait()
        self.assertEqual((result.exit_code, result.timed_out), (0, False))
        self.assertIn('here I am\n', result.out)
        self.assertTrue(run.directory.exists())
        directory = run.directory
        run.close()
        self.assertFalse(directory.exists())
        with self.assertRaisesRegex(RuntimeError, 'the run is closed'):
            run.wait()

    def test_a_program_that_leaves_a_process(self):
        script = "x=$(setsid /bin/sh -c 'exec sleep 600 >/dev/null' &)"  # ends when the other one is in its own session
        result = LaunchRun(programs=[['/bin/sh', '-c', script]], events=[]).wait()
        self.assertEqual(len(result.left), 1, result.out + result.err)
        self.assertRegex(result.left[0], r'^sh-1 left 1 process running: sleep \([0-9]+\)$')

    def test_a_program_that_is_ended(self):
        run = LaunchRun(programs=[['sleep', '600']], events=[])
        self.assertTrue(run.wait_for_output('process started with pid'))
        self.assertFalse(run.stop().timed_out)


if __name__ == '__main__':
    unittest.main()
