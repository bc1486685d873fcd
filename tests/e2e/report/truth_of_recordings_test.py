# SPDX-License-Identifier: Apache-2.0
"""What the report says is what the trace says, however it was recorded: in parts, late, by several sessions, with losses."""

import json
import os
import subprocess
import unittest
from pathlib import Path

from own_launch import IS_ROOT, launch, launch_on_hosts, started
from stream_files import packet_ends
from trace_truth import Truth, events_once
from truth_case import TruthCase

EXAMPLES = Path(os.environ['SOURCE_DIRECTORY']) / 'launch_examples'
LAUNCH = os.environ['LAUNCH_PROGRAM']

# Nodes that publish and answer one another.
RUNNING = f'''
  <node pkg="demo_nodes" exec="talker"/>
  <node pkg="demo_nodes" exec="listener"/>
  <executable cmd="{os.environ["EXECUTOR_THREADS_WORKER"]}"/>
  <node pkg="demo_nodes" exec="pong"/>
  <node pkg="demo_nodes" exec="ping"><param name="count" value="0"/><param name="period_ms" value="20"/></node>'''
# The same for a while.
NODES = f'{RUNNING}<timer period="2.5"><shutdown/></timer>'
NODES_FOR_LONG = f'{RUNNING}<timer period="6"><shutdown/></timer>'
# Two nodes that send this many messages, however long it takes.
MANY_MESSAGES = '''<node pkg="demo_nodes" exec="pong"/>
  <node pkg="demo_nodes" exec="ping" on_exit="shutdown"><param name="count" value="1000"/><param name="period_ms" value="2"/></node>'''


class Recordings(TruthCase):

    def test_two_runs_that_are_appended(self):
        file = self.directory / 'appended.launch.xml'
        file.write_text(f'''<launch><trace session-name="appended" append-trace="true"/>
          <executable cmd="{os.environ["EXECUTOR_THREADS_WORKER"]}"/></launch>''')
        self.check(self.record(file, times=2), 10)

    def test_channels(self):
        self.check(self.record(EXAMPLES / '21_trace_channels.launch.xml'), 1)

    def test_small_packets(self):
        self.check(self.record_text(f'<include file="{EXAMPLES / "02_names.launch.xml"}"/>',
                                    'subbuffer-size-ust="16384" subbuffer-count-ust="64"'), 4)

    def test_small_files_of_each_process(self):
        self.check(self.record_text(f'<include file="{EXAMPLES / "02_names.launch.xml"}"/>',
                                    'buffers-ust="pid" subbuffer-size-ust="65536" subbuffer-count-ust="16"'), 4)

    def test_a_rotated_session(self):
        rotate = '<executable cmd="lttng rotate truth"/>'
        trace = self.record_text(f'{NODES}<timer period="0.7">{rotate}</timer><timer period="1.6">{rotate}</timer>',
                                 append_timestamp='false')
        self.assertGreaterEqual(len(list((trace / 'truth/archives').iterdir())), 3)
        self.check(trace, 10)

    def test_two_sessions_at_once(self):
        file = self.directory / 'twice.launch.xml'
        file.write_text(f'<launch><trace session-name="one"/><trace session-name="two" events-ust="ros2:*"/>{NODES}</launch>')
        traces = self.record(file)
        self.check(traces, 10, truth=Truth(events_once(sorted(traces.iterdir()))))

    def test_a_second_session_that_begins_late(self):
        file = self.directory / 'late.launch.xml'
        file.write_text(f'<launch><trace session-name="one"/>{NODES_FOR_LONG}'
                        '<timer period="1.2"><trace session-name="two"/></timer></launch>')
        traces = self.record(file)
        self.check(traces, 10, truth=Truth(events_once(sorted(traces.iterdir()))), has_early_events=True)

    def test_a_session_that_begins_late(self):
        file = self.directory / 'late.launch.xml'
        file.write_text(f'<launch>{NODES_FOR_LONG}<timer period="1"><trace session-name="late"/></timer></launch>')
        self.check(self.record(file), 5)

    def test_a_paused_session(self):
        command = f'<executable cmd="{LAUNCH} trace {{}} truth"/>'
        self.check(self.record_text(f'{NODES}<timer period="0.8">{command.format("pause")}</timer>'
                                    f'<timer period="1.6">{command.format("resume")}</timer>', append_timestamp='false'), 10)

    def test_saved_initialisations(self):
        command = f'<executable name="{{0}}" cmd="{LAUNCH} trace {{0}} dual -d"/>'
        file = self.directory / 'dual.launch.xml'
        file.write_text(f'''<launch><trace session-name="dual" dual-session="true"/>{RUNNING}
          <timer period="0.8">{command.format("start")}</timer>
          <on_process_exit process="start"><timer period="1.5">{command.format("stop")}</timer></on_process_exit>
          <on_process_exit process="stop"><shutdown/></on_process_exit></launch>''')
        self.check(self.record(file), 5)

    def test_a_simulated_clock(self):
        directory = self.directory / 'clock'
        file = self.directory / 'clock.launch.xml'
        file.write_text('''<launch>
          <trace session-name="truth"/>
          <set_parameter name="use_sim_time" value="true"/>
          <node pkg="demo_nodes" exec="talker"/>
          <node pkg="demo_nodes" exec="listener"/>
          <test name="fast time">
            <clock name="time" rate="4" start="1000"/>
            <receive name="later" topic="/clock" type="rosgraph_msgs/msg/Clock" where="clock.sec >= 1010"/>
            <exit process="later" within="60"/>
          </test></launch>''')
        launch(self.directory, 'test', '--keep', '--directory', directory, file)
        output = next(directory.rglob('output.txt')).read_text()
        self.started = started(subprocess.CompletedProcess([], 0, output, ''))
        self.check(next(path for path in directory.rglob('own_traces/*') if path.is_dir()), 3)

    def test_overwritten_packets(self):
        self.check(self.record_text(MANY_MESSAGES, 'overwrite-ust="true" subbuffer-size-ust="4096" subbuffer-count-ust="2" '
                                    'read-timer-ust="900000" init-channel="true"'), 3, is_whole=False)

    def test_overwritten_files(self):
        self.check(self.record_text(MANY_MESSAGES, 'tracefile-size="16384" tracefile-count="2" subbuffer-size-ust="4096" '
                                    'subbuffer-count-ust="64" init-channel="true"'), 3, is_whole=False)

    def test_snapshots(self):
        traces = self.record(EXAMPLES / '20_flight_recorder.launch.xml')
        self.check(traces, 1)

    def test_a_trace_that_was_cut(self):
        trace = self.record_text(MANY_MESSAGES, 'subbuffer-size-ust="16384" subbuffer-count-ust="64"')
        for index in trace.rglob('*.idx'):
            if ends := packet_ends(index):
                os.truncate(index.parent.parent / index.stem, ends[len(ends) // 2])
        self.check(trace, 3, code=1, is_whole=False)

    @unittest.skipUnless(IS_ROOT, 'a host of another name needs root')
    def test_two_hosts(self):
        file = self.directory / 'host.launch.xml'
        file.write_text(f'<launch><arg name="host"/><trace session-name="$(var host)"/>{NODES}</launch>')
        self.started = started(launch_on_hosts(self.directory, ('left', 'right'), file))
        trace = self.directory / 'traces'
        hosts = json.loads(subprocess.run([os.environ['LAUNCH_REPORT'], trace, '--json'], check=True,
                                          stdout=subprocess.PIPE).stdout)
        self.assertEqual({process['host'] for process in hosts['processes']}, {'left', 'right'})
        self.check(trace, 10)


if __name__ == '__main__':
    unittest.main()
