# SPDX-License-Identifier: Apache-2.0
"""What the report says is what the trace says, however it was recorded: in parts, late, by several sessions, with losses."""

import json
import os
import subprocess
import unittest

from own_launch import IS_ROOT, launch, launch_on_hosts, started
from stream_files import packet_ends
from trace_truth import Truth, events_once
from truth_case import NAMES, TruthCase

LAUNCH = os.environ['LAUNCH_PROGRAM']

# Nodes that publish and answer one another.
RUNNING = f'''
  <node pkg="demo_nodes" exec="talker"/>
  <node pkg="demo_nodes" exec="listener"/>
  <executable cmd="{os.environ["EXECUTOR_THREADS_WORKER"]}"/>
  <node pkg="demo_nodes" exec="pong"/>
  <node pkg="demo_nodes" exec="ping"><param name="count" value="0"/><param name="period_ms" value="20"/></node>'''
ANSWERS = '<on_process_io process="ping" pattern="ping [0-9]*[05]0 answered" once="true">{}</on_process_io>'


def in_turn(*steps):
    """
    Takes each step when up to fifty more messages have been answered since the one before, however long that takes, and at last
    ends the system. A step is a tag, or a command, which has ended when the answers are counted.
    """
    content = '<shutdown/>'
    for number, step in reversed(list(enumerate(steps))):
        content = ANSWERS.format(content)
        if step and not step.startswith('<'):
            step = f'<executable name="step_{number}" cmd="{step}"/>'
            content = f'<on_process_exit process="step_{number}">{content}</on_process_exit>'
        content = step + content
    return content


NODES = RUNNING + in_turn('', '')
# The talker's third message has been heard.
TALKER_AND_LISTENER = '''<node pkg="demo_nodes" exec="talker"/>
  <node pkg="demo_nodes" exec="listener"/>
  <on_process_io pattern="I heard.*World: 3"><shutdown/></on_process_io>'''
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
        file = self.directory / 'channels.launch.xml'
        file.write_text(f'''<launch>
          <trace session-name="channels" nodes="listener"
                 events-ust="'ros2:* except ros2:rclcpp_executor_*,ros2:callback_*,ros2:rmw_take' 'ros2:rmw_take if taken == 1'">
            <channel name="callbacks" events-ust="ros2:callback_*" subbuffer-size="65536" context-fields="vpid vtid"/>
          </trace>{TALKER_AND_LISTENER}</launch>''')
        self.check(self.record(file), 1)

    def test_small_packets(self):
        self.check(self.record_text(NAMES,
                                    'subbuffer-size-ust="16384" subbuffer-count-ust="64"'), 4)

    def test_small_files_of_each_process(self):
        self.check(self.record_text(NAMES,
                                    'buffers-ust="pid" subbuffer-size-ust="65536" subbuffer-count-ust="16"'), 4)

    def test_a_rotated_session(self):
        rotate = 'lttng rotate truth'
        trace = self.record_text(RUNNING + in_turn('', rotate, rotate), append_timestamp='false')
        self.assertGreaterEqual(len(list((trace / 'truth/archives').iterdir())), 3)
        self.check(trace, 10)

    def test_two_sessions_at_once(self):
        file = self.directory / 'twice.launch.xml'
        file.write_text(f'<launch><trace session-name="one"/><trace session-name="two" events-ust="ros2:*"/>{NODES}</launch>')
        traces = self.record(file)
        self.check(traces, 10, truth=Truth(events_once(sorted(traces.iterdir()))))

    def test_a_second_session_that_begins_late(self):
        file = self.directory / 'late.launch.xml'
        steps = in_turn('', '<trace session-name="two"/>', '')
        file.write_text(f'<launch><trace session-name="one"/>{RUNNING}{steps}</launch>')
        traces = self.record(file)
        self.check(traces, 10, truth=Truth(events_once(sorted(traces.iterdir()))))

    def test_a_session_that_begins_late(self):
        file = self.directory / 'late.launch.xml'
        steps = in_turn('', '<trace session-name="late"/>', '')
        file.write_text(f'<launch>{RUNNING}{steps}</launch>')
        self.check(self.record(file), 5)

    def test_a_paused_session(self):
        steps = in_turn('', f'{LAUNCH} trace pause truth', f'{LAUNCH} trace resume truth')
        self.check(self.record_text(RUNNING + steps, append_timestamp='false'), 10)

    def test_saved_initialisations(self):
        file = self.directory / 'dual.launch.xml'
        file.write_text(f'''<launch><trace session-name="dual" dual-session="true"/>{RUNNING}
          {in_turn('', f'{LAUNCH} trace start dual -d', '', f'{LAUNCH} trace stop dual -d')}</launch>''')
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
        file = self.directory / 'flight.launch.xml'
        unlucky = '<executable cmd="kill -SEGV $$" shell="true" allowed-exit-codes="SIGSEGV"/>'
        file.write_text(f'<launch><trace session-name="flight" snapshot-on-crash="true"/>{RUNNING}{in_turn("", unlucky)}</launch>')
        self.check(self.record(file), 5)

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
