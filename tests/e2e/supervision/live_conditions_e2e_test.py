# SPDX-License-Identifier: Apache-2.0
"""Conditions on what nodes do, with real nodes and a real session: <on_silence>, <on_rate>, <on_late>, <on_loss>; and those on
processes, without a session: <on_memory>, <on_overload>."""

import json
import os
import re
import signal
import subprocess
import time
import unittest
from pathlib import Path

from own_launches import LAUNCH, PATIENCE, OwnLaunches

HANGING_NODE = os.environ['HANGING_NODE']


def node(what, more=''):
    """A node /hanging_node with a timer of 50 ms that publishes /beats; `what` says how it goes on after 5 or 20 ticks."""
    return f'<executable name="driver" output="screen" sigterm_timeout="0.5" sigkill_timeout="0.5" cmd="{HANGING_NODE} {what}" {more}/>'


class LiveConditions(OwnLaunches):
    def setUp(self):
        super().setUp()
        self.traces = self.folder / 'traces'
        # What a relay daemon had recorded stays behind when launch-watch is killed, until the next one starts.
        self.environment.update(ROS_TRACE_DIR=str(self.traces), TMPDIR=str(self.folder))
        self.name = f'conditions-{self.folder.name}'
        self.trace = f'<trace session-name="{self.name}"/>\n'

    def run_launch(self, actions):
        (self.folder / 'system.launch.xml').write_text(f'<launch>\n{actions}\n</launch>\n')
        return self.start(LAUNCH, 'system.launch.xml')

    def interrupt(self, launch):
        launch.send_signal(signal.SIGINT)
        return launch.wait(PATIENCE)

    def watch_of(self, launch):
        """The launch-watch of a launch, whose argument is the number in the mark of each process."""
        environment = Path(f'/proc/{self.pid_of(launch, "driver-1")}/environ').read_text()
        mark = next(part for part in environment.split('\0') if part.startswith('LAUNCH_PROCESS='))
        found = subprocess.run(['pgrep', '-f', f'launch-watch --conditions {mark.partition("=")[2].partition(":")[0]}( |$)'],
                               capture_output=True, text=True)
        return [int(word) for word in found.stdout.split()]

    def assert_nothing_left(self, watch):
        """Neither the session of the conditions nor its programs."""
        end = time.monotonic() + PATIENCE
        while os.path.exists(f'/proc/{watch}'):
            self.assertLess(time.monotonic(), end)
            time.sleep(0.05)
        while f'launch-conditions-{watch} ' in subprocess.run(['lttng', 'list'], capture_output=True, text=True).stdout:
            self.assertLess(time.monotonic(), end)
            time.sleep(0.05)

    def test_a_stopped_node_is_restarted_by_its_silence(self):
        launch = self.run_launch(f'''{self.trace}{node('ever')}
          <on_silence node="/hanging_node" for="1s" cool_down="1s"><restart process="$(var event.process)"/></on_silence>
          <on_silence topic="/beats" for="1s"><log message="silent: $(var event.topic), $(var event.process), $(var event.for)"/></on_silence>''')
        launch.lines.wait_for('tick 40')  # after 2 s
        [watch] = self.watch_of(launch)
        events = self.start(LAUNCH, 'events', '--launch', str(launch.pid))
        stopped = self.pid_of(launch, 'driver-1')
        os.kill(stopped, signal.SIGSTOP)
        line = launch.lines.wait_for('no callback of /hanging_node has ended')
        self.assertRegex(line, r'\[WARNING\] \[launch\.condition\]: no callback of /hanging_node has ended for 1\.?[0-9]* s \(driver-1\)$')
        launch.lines.wait_for('silent: /beats, driver-1, 1s')
        launch.lines.wait_for('the silence of /hanging_node is over after')
        event = json.loads(events.lines.wait_for('"node":"/hanging_node","holds":true'))
        self.assertEqual((event['event'], event['condition'], event['processes']),
                         ('condition', 'on_silence of node /hanging_node for 1s', ['driver-1']))
        self.assertGreaterEqual(event['silent_for'], 1)
        self.assertEqual(event['place']['line'], 4)
        # The stopped node may go on for a moment when it is told to end.
        end = time.monotonic() + PATIENCE
        while self.pid_of(launch, 'driver-1') in (stopped, None):
            self.assertLess(time.monotonic(), end)
            time.sleep(0.05)
        self.interrupt(launch)
        self.assert_nothing_left(watch)
        verdict = json.loads((self.traces / self.name / 'verdict.json').read_text())
        self.assertTrue(verdict['complete'], verdict)
        self.assertEqual([line for line in launch.lines.seen if 'no callback of' in line], [line])

    def test_a_node_that_hangs_in_a_callback_is_silent(self):
        launch = self.run_launch(f'''{self.trace}{node('sleep')}
          <on_silence node="/hanging_node" for="1s"><shutdown reason="$(var event.process) hangs"/></on_silence>''')
        launch.lines.wait_for('no callback of /hanging_node has ended for 1')
        self.assertEqual(launch.wait(PATIENCE), 0)

    def test_a_rate_that_falls(self):
        launch = self.run_launch(f'''{self.trace}{node('slow')}
          <on_rate topic="/beats" below="10" window="500ms"><shutdown reason="$(var event.rate) of $(var event.below) in $(var event.window)"/></on_rate>''')
        line = launch.lines.wait_for('messages/s on /beats in 500ms')
        self.assertRegex(line, r'[0-9.]+ messages/s on /beats in 500ms, which is below 10 \(driver-1\)$')
        self.assertEqual(launch.wait(PATIENCE), 0)

    def test_a_rate_that_is_too_high(self):
        launch = self.run_launch(f'''{self.trace}{node('ever')}
          <on_rate topic="/beats" above="10" window="500ms" once="true"><shutdown/></on_rate>''')
        self.assertRegex(launch.lines.wait_for('messages/s on /beats'), r'(18|20|22|24) messages/s on /beats in 500ms, which is above 10 \(driver-1\)$')
        self.assertEqual(launch.wait(PATIENCE), 0)

    def test_a_callback_that_runs_too_long_and_the_message_that_waits_for_it(self):
        launch = self.run_launch(f'''{self.trace}{node('late')}
          <on_late node="/hanging_node" max="150ms" window="500ms">
            <log message="node: $(var event.node), $(var event.process), $(var event.max)"/>
          </on_late>
          <on_late topic="/beats" max="150ms" share="0.99" window="500ms"><log message="topic: $(var event.took), $(var event.share)"/></on_late>''')
        line = launch.lines.wait_for('a callback of /hanging_node took')
        self.assertRegex(line, r'\[WARNING\] \[launch\.condition\]: a callback of /hanging_node took [0-9.]+ ms, more than 150ms \(driver-1\)$')
        launch.lines.wait_for('node: /hanging_node, driver-1, 150ms')
        line = launch.lines.wait_for('topic: ')
        self.assertGreater(float(line.partition('topic: ')[2].partition(',')[0]), 0.15)
        launch.lines.wait_for('callbacks of /hanging_node take no longer than 150ms again (driver-1)')
        launch.lines.wait_for('messages on /beats take no longer than 150ms again (driver-1)')
        self.assertEqual(self.interrupt(launch), 0)

    def test_a_timer_and_a_chain_that_are_late(self):
        launch = self.run_launch(f'''{self.trace}{node('late')}
          <on_late timer="/hanging_node" max="150ms" once="true"><log message="timer: $(var event.timer), $(var event.process)"/></on_late>
          <on_late chain="/hanging_node -> hanging_node" max="150ms" once="true"><log message="chain: $(var event.chain)"/></on_late>
          <on_late chain="/hanging_node -> /brake" max="150ms" grace="1s"/>''')
        launch.lines.wait_for('no node /brake was ever seen, 1s after the begin of the recording')
        self.assertRegex(launch.lines.wait_for('a timer of /hanging_node waited'), r' waited [0-9.]+ ms, more than 150ms \(driver-1\)$')
        launch.lines.wait_for('timer: /hanging_node, driver-1')
        self.assertRegex(launch.lines.wait_for('the way /hanging_node -> /hanging_node took'), r' took [0-9.]+ ms, more than 150ms \(driver-1\)$')
        launch.lines.wait_for('chain: /hanging_node -> /hanging_node')
        self.assertEqual(self.interrupt(launch), 0)

    def test_messages_that_are_lost(self):
        launch = self.run_launch(f'''{self.trace}{node('flood')}
          <on_loss topic="/beats" window="500ms"><log message="lost: $(var event.topic), $(var event.lost), $(var event.above)"/></on_loss>''')
        line = launch.lines.wait_for('on /beats lost')
        self.assertRegex(line, r'\[WARNING\] \[launch\.condition\]: [0-9]+ messages? on /beats lost \(driver-1\)$')
        launch.lines.wait_for('lost: /beats, ')
        launch.lines.wait_for('no message on /beats is lost any more (driver-1)')
        self.assertEqual(self.interrupt(launch), 0)

    def niceness_of(self, pid):
        """That of each thread."""
        return {os.getpriority(os.PRIO_PROCESS, int(thread)) for thread in os.listdir(f'/proc/{pid}/task')}

    def test_a_process_that_gets_another_priority_and_its_own_back(self):
        launch = self.run_launch(f'''{self.trace}{node('late')}
          <on_late node="/hanging_node" max="150ms" window="500ms">
            <set_priority process="driver" nice="5" cpus="0"/>
            <set_priority process="driver" nice="7"/>
          </on_late>
          <on_process_io pattern="tick 80$" once="true"><restore_priority process="driver"/></on_process_io>''')
        launch.lines.wait_for('tick 20')
        events = self.start(LAUNCH, 'events', '--launch', str(launch.pid))
        pid = self.pid_of(launch, 'driver-1')
        before = self.niceness_of(pid), os.sched_getaffinity(pid)
        self.assertRegex(launch.lines.wait_for('scheduling'), r'\[INFO\] \[driver-1\]: its scheduling is nice 5, cpus 0 now$')
        self.assertRegex(launch.lines.wait_for('nice 7'), r'\[INFO\] \[driver-1\]: its scheduling is nice 7 now$')
        self.assertEqual((self.niceness_of(pid), os.sched_getaffinity(pid)), ({7}, {0}))
        self.assertEqual(json.loads(events.lines.wait_for('"scheduling"'))['to'], ['nice 5', 'cpus 0'])
        if os.geteuid() == 0:  # others may not become more urgent again
            launch.lines.wait_for('its scheduling is what it was')
            self.assertEqual((self.niceness_of(pid), os.sched_getaffinity(pid)), before)
        self.assertEqual(self.interrupt(launch), 0)
        read = subprocess.run([LAUNCH, 'trace', 'read', str(self.traces / self.name), '--event', 'launch:scheduling', '--event', 'launch:condition'],
                              capture_output=True, text=True, check=True).stdout
        self.assertRegex(read, r'launch:scheduling .*process="driver-1" change="nice 5, cpus 0" file="\S+system.launch.xml" line=3')
        self.assertRegex(read, r'launch:condition .*condition="on_late of node /hanging_node above 150ms" change="a callback of /hanging_node took')
        report = subprocess.run([LAUNCH, 'report', str(self.traces / self.name)], capture_output=True, text=True, check=True).stdout
        self.assertRegex(report, r'(?s)\nWhile it ran\n.* s  on_late of node /hanging_node above 150ms.*took .* s  driver-1: its threads get processors by nice 5, cpus 0\n')

    def test_a_process_that_has_too_much_memory_is_restarted(self):
        (self.folder / 'eater.py').write_text('import time\nprint("eats", flush=True)\ntime.sleep(1)\nkept = b"x" * (200 << 20)\ntime.sleep(1000)\n')
        launch = self.run_launch('''<executable name="eater" cmd="/usr/bin/python3 eater.py" output="screen" sigterm_timeout="0.5" sigkill_timeout="0.5"/>
          <on_memory process="eater" above="150M" for="500ms" once="true">
            <log message="memory: $(var event.process), $(var event.above), $(var event.for)"/>
            <restart process="eater"/>
          </on_memory>
          <on_memory process="eter" above="150M" grace="1s"/>''')
        self.assertRegex(launch.lines.wait_for('of memory'), r'\[WARNING\] \[launch\.condition\]: eater has 2[0-9.]+ MiB of memory, for 500ms more than 150 MiB \(eater-1\)$')
        launch.lines.wait_for('memory: eater-1, 157286400, 500ms')
        launch.lines.wait_for('eats')
        self.assertEqual(self.interrupt(launch), 0)

    def test_a_process_that_takes_a_whole_processor(self):
        launch = self.run_launch('''<executable name="busy" cmd="sh -c 'while :; do :; done'"/>
          <on_overload process="busy" above="20%" for="1s"><log message="load: $(var event.process), $(var event.above)"/><shutdown/></on_overload>''')
        self.assertRegex(launch.lines.wait_for('of a processor'), r'busy takes [0-9.]+ % of a processor in 1s, more than 20 % \(busy-1\)$')
        launch.lines.wait_for('load: busy-1, 0.2')
        self.assertEqual(launch.wait(PATIENCE), 0)

    def test_a_condition_that_comes_later_and_needs_more(self):
        launch = self.run_launch(f'''{self.trace}{node('late')}
          <on_silence topic="/beats" for="10s"/>
          <on_process_io pattern="tick 20$"><on_late topic="/beats" max="150ms" once="true"><shutdown/></on_late></on_process_io>''')
        launch.lines.wait_for('a message on /beats took ')
        self.assertEqual(launch.wait(PATIENCE), 0)

    def test_a_name_that_nothing_has_is_told_with_a_similar_one(self):
        launch = self.run_launch(f'''{self.trace}{node('ever')}
          <on_silence topic="/beat" for="1s" grace="2s"/>''')
        line = launch.lines.wait_for('was ever seen')
        self.assertRegex(line, r'no publisher of /beat was ever seen, 2s after the begin of the recording \(\S*system.launch.xml:4:12\); '
                               r"did you mean '/beats'\?$")
        self.assertEqual(self.interrupt(launch), 0)

    def test_a_watch_that_is_killed_is_started_again(self):
        launch = self.run_launch(f'''{self.trace}{node('ever')}
          <on_silence topic="/beats" for="1s" once="true"><log message="silent"/></on_silence>''')
        launch.lines.wait_for('tick 60')
        [watch] = self.watch_of(launch)
        os.kill(watch, signal.SIGKILL)
        launch.lines.wait_for('are not watched for a moment: launch-watch was ended by SIGKILL')
        self.assert_nothing_left(watch)
        ticks = max(int(found.group(1)) for found in (re.search(r'tick (\d+)', line) for line in launch.lines.seen) if found)
        launch.lines.wait_for(f'tick {ticks + 100}')
        os.kill(self.pid_of(launch, 'driver-1'), signal.SIGSTOP)
        launch.lines.wait_for('silent')
        self.interrupt(launch)
        self.assertEqual(list(self.folder.glob('launch-watch-*')), [])

    def test_kill_9_of_the_launcher_leaves_no_session(self):
        launch = self.run_launch(f'''{self.trace}{node('ever')}<on_silence topic="/beats" for="1s"/>''')
        launch.lines.wait_for('tick 40')
        [watch] = self.watch_of(launch)
        launcher = subprocess.run(['ps', '-o', 'ppid=', '-p', str(watch)], capture_output=True, text=True).stdout.strip()
        os.kill(int(launcher), signal.SIGKILL)
        launch.wait(PATIENCE)
        self.assert_nothing_left(watch)

    def test_without_a_trace_nothing_starts(self):
        launch = self.run_launch(f'''{node('ever')}<on_silence topic="/beats" for="1s"/>''')
        launch.lines.wait_for('add <trace session-name="…"/> to the launch file, or start it with launch --trace')
        self.assertEqual(launch.wait(PATIENCE), 1)
        self.assertFalse([line for line in launch.lines.seen if 'process started' in line])


if __name__ == '__main__':
    unittest.main()
