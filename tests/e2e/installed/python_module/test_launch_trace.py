# SPDX-License-Identifier: Apache-2.0
"""Tests of the module launch_trace, with the traces that python_module_test.cpp writes."""

import gc
import os
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

if os.environ['WITHOUT_MODULE']:
    sys.modules[os.environ['WITHOUT_MODULE']] = None

try:
    import numpy
except ImportError:
    numpy = None

import launch_trace

TRACES = Path(os.environ['TRACES'])


class Events(unittest.TestCase):

    def test_events_and_losses_come_in_the_order_of_time(self):
        items = list(launch_trace.Trace(TRACES / 'whole'))
        self.assertEqual([item.time_ns for item in items], [100, 200, 210, 220, 230, 240, 240, 250, 300])
        loss = items[6]
        self.assertIsInstance(loss, launch_trace.Loss)
        self.assertEqual((loss.kind, loss.count, loss.end_ns), ('events', 3, 300))
        self.assertTrue(loss.stream.endswith('whole/ros2_0'))
        self.assertEqual(repr(loss), '<Loss of 3 events at 240 ns>')

    def test_an_event_has_its_name_and_contexts(self):
        event = next(iter(launch_trace.Trace(str(TRACES / 'whole'))))
        self.assertIsInstance(event, launch_trace.Event)
        self.assertEqual(event.name, 'ros2:rcl_node_init')
        self.assertEqual((event.cpu_id, event.vpid, event.vtid, event.procname), (0, 71, 72, 'ping'))
        self.assertEqual(event.host, 'box')
        self.assertEqual(event.contexts, {'vppid': 70})
        self.assertEqual(event['vppid'], 70)

    def test_an_event_has_its_fields(self):
        event = next(iter(launch_trace.Trace(TRACES / 'whole')))
        self.assertEqual(event['node_handle'], 0xffff800000000001)
        self.assertEqual(event['node_name'], 'tal\N{REPLACEMENT CHARACTER}ker')
        self.assertEqual(event.keys(), ['node_handle', 'rmw_handle', 'node_name', 'namespace'])
        self.assertEqual(dict(event)['namespace'], '/ns')
        self.assertEqual(list(event), event.keys())
        self.assertEqual(len(event), 4)
        self.assertIn('rmw_handle', event)
        self.assertNotIn('gid', event)
        self.assertIsNone(event.get('gid'))
        self.assertEqual(event.get('gid', 3), 3)
        with self.assertRaises(KeyError) as caught:
            event['gid']
        self.assertEqual(caught.exception.args[0], "ros2:rcl_node_init has no field 'gid'")
        self.assertEqual(repr(event), "<ros2:rcl_node_init at 100 ns node_handle=18446603336221196289 rmw_handle=2 "
                                      "node_name='tal\N{REPLACEMENT CHARACTER}ker' namespace='/ns'>")

    def test_every_kind_of_field_is_an_object(self):
        event, = launch_trace.Trace(TRACES / 'whole').events('own:*')
        self.assertEqual(event.values, (0.5, (1, 2, 3), {'inner': -2}))

    def test_a_pattern_chooses_events(self):
        trace = launch_trace.Trace(TRACES / 'whole')
        self.assertEqual([event['is_intra_process'] for event in trace.events('ros2:callback_*')], [0, 1, 0, 1, 0])
        self.assertEqual(len(list(trace.events())), 8)
        self.assertEqual(len(list(trace.events('ros2:rmw_t?ke', 'own:values'))), 2)
        self.assertEqual(list(trace.events('nothing')), [])

    def test_several_directories_are_merged(self):
        trace = launch_trace.Trace([TRACES / 'whole', TRACES / 'other'])
        self.assertEqual([event.time_ns for event in trace.events('ros2:rcl_node_init')], [100, 150])
        self.assertEqual(trace.directories, [TRACES / 'whole', TRACES / 'other'])

    def test_events_stay_when_everything_else_has_gone(self):
        events = list(launch_trace.Trace(TRACES / 'whole').events('ros2:rcl_node_init', 'own:values'))
        gc.collect()
        self.assertEqual(events[0]['namespace'], '/ns')
        self.assertEqual(events[1]['bytes'], (1, 2, 3))

    def test_events_are_not_made_by_hand(self):
        with self.assertRaises(TypeError):
            launch_trace.Event()


class Columns(unittest.TestCase):

    def setUp(self):
        self.trace = launch_trace.Trace(TRACES / 'whole')

    def test_a_column_holds_a_field_of_all_events_of_a_name(self):
        columns = self.trace.columns('ros2:callback_start', ['time_ns', 'callback', 'vppid', 'procname'])
        self.assertEqual(list(columns), ['time_ns', 'callback', 'vppid', 'procname'])
        self.assertEqual(columns['time_ns'].tolist(), [200, 210, 220, 230, 240])
        self.assertEqual(columns['callback'].tolist(), [0, 1, 2, 3, 4])
        self.assertEqual(columns['vppid'].tolist(), [70] * 5)
        self.assertEqual(list(columns['procname']), ['ping'] * 5)

    def test_without_names_all_fields_are_there(self):
        columns = self.trace.columns('ros2:rmw_take')
        self.assertEqual(list(columns), ['time_ns', 'cpu_id', 'vpid', 'vtid', 'procname', 'host', 'rmw_subscription_handle',
                                         'message', 'source_timestamp', 'taken'])
        self.assertEqual(columns['source_timestamp'].tolist(), [-7])
        self.assertEqual(list(columns['host']), ['box'])

    def test_numbers_are_an_array_or_a_memoryview(self):
        columns = self.trace.columns('own:values', ['ratio', 'bytes', 'time_ns'])
        expected = numpy.ndarray if numpy else memoryview
        self.assertIsInstance(columns['ratio'], expected)
        self.assertEqual(columns['ratio'].tolist(), [0.5])
        self.assertEqual(list(columns['bytes']), [(1, 2, 3)])
        gc.collect()
        self.assertEqual(columns['ratio'][0], 0.5)
        handles = self.trace.columns('ros2:rcl_node_init', ['node_handle'])['node_handle']
        self.assertEqual(int(handles[0]), 0xffff800000000001)
        if numpy:
            self.assertEqual((handles.dtype, columns['time_ns'].dtype), (numpy.uint64, numpy.int64))
        else:
            self.assertEqual((handles.format, columns['time_ns'].format), ('Q', 'q'))

    def test_an_event_that_never_happened_has_empty_columns(self):
        columns = self.trace.columns('ros2:rcl_publish', ['time_ns', 'message'])
        self.assertEqual([len(column) for column in columns.values()], [0, 0])
        self.assertEqual(len(self.trace.columns('ros2:rcl_publish')['time_ns']), 0)

    def test_an_unknown_field_is_an_error(self):
        with self.assertRaises(KeyError) as caught:
            self.trace.columns('ros2:callback_start', ['calback'])
        self.assertEqual(caught.exception.args[0],
                         "ros2:callback_start has no field 'calback'; it has callback, is_intra_process, time_ns, cpu_id, "
                         "vpid, vtid, procname, host")


class Damage(unittest.TestCase):

    def test_a_directory_that_is_no_trace_is_an_error(self):
        with self.assertRaises(launch_trace.TraceError) as caught:
            launch_trace.Trace('/nonexistent/trace')
        self.assertEqual(str(caught.exception), "cannot read the trace '/nonexistent/trace': no such directory\n"
                         "      = help: give the directory that the launcher printed when it ended the session")

    def test_the_end_of_a_damaged_trace_is_an_error(self):
        seen = []
        with self.assertRaises(launch_trace.TraceError) as caught:
            for event in launch_trace.Trace(TRACES / 'damaged'):
                seen.append(event.time_ns)
        self.assertEqual(seen, [1])
        self.assertIn('ends behind the end of the file', str(caught.exception))

    def test_damage_can_be_asked_for_instead(self):
        trace = launch_trace.Trace(TRACES / 'damaged', damage_is_error=False)
        self.assertEqual(trace.columns('ros2:rcl_take', ['message'])['message'].tolist(), [5])
        self.assertTrue(trace.damage[0].endswith('ends behind the end of the file'), trace.damage)
        self.assertEqual(trace.open_directories, [])

    def test_a_trace_that_is_still_being_written_is_no_damage(self):
        with open(TRACES / 'damaged/ros2_0', 'ab'):
            trace = launch_trace.Trace(TRACES / 'damaged')
            self.assertEqual(list(trace), [])
            self.assertEqual(trace.open_directories, [TRACES / 'damaged'])

    def test_an_open_trace_says_that_events_are_not_described_yet(self):
        with tempfile.TemporaryDirectory() as directory:
            copy = Path(shutil.copytree(TRACES / 'other', Path(directory) / 'copy'))
            metadata = (copy / 'metadata').read_text()
            (copy / 'metadata').write_text(metadata[:metadata.rindex('event {')])
            with open(copy / 'ros2_0', 'ab'):
                trace = launch_trace.Trace(copy)
                self.assertEqual([event.name for event in trace], ['ros2:rcl_node_init'])
                self.assertTrue(trace.lacks_descriptions)
                self.assertEqual(trace.damage, [])
        trace = launch_trace.Trace(TRACES / 'other')
        self.assertEqual(len(list(trace)), 2)
        self.assertFalse(trace.lacks_descriptions)


if __name__ == '__main__':
    unittest.main()
