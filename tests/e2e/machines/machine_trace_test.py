# SPDX-License-Identifier: Apache-2.0
"""A trace of several machines: a session on each, one directory at the end, one verdict; also when something dies."""

import json
import os
import re
import signal
import subprocess
import time
import unittest
from pathlib import Path

from machine_hosts import LAUNCH, PATIENCE, Host
from traced_machines import TracedMachines


class MachineTrace(TracedMachines):
    def report(self):
        return json.loads(subprocess.run([LAUNCH, 'report', self.traces / self.name, '--json'], check=True, stdout=subprocess.PIPE,
                                         timeout=PATIENCE, env=self.environment).stdout)

    def wait_for_verdict(self, host):
        """Of the recording that stays there. The guardian writes it when the session has ended."""
        end = time.monotonic() + PATIENCE
        while not (found := list((host.folder / '.ros/tracing').glob(f'{self.name}-*/verdict.json'))):
            if time.monotonic() > end:
                self.fail(f'there is no verdict on {host.name}, only {self.left_in(host)}')
            time.sleep(0.05)  # nothing tells of what happens on another machine
        return found

    def test_one_trace_of_two_machines(self):
        self.hosts[0].link(self.hosts[1])
        launch = self.start_nodes(f'<trace session-name="{self.name}"/>')
        launch.lines.wait_for('[base:listener-2] [INFO]')
        self.assertEqual(self.interrupt(launch), 0, launch.lines.seen)
        lines = launch.lines.seen
        begun = next(i for i, line in enumerate(lines) if 'recording on machines arm, base' in line)
        started = next(i for i, line in enumerate(lines) if 'process started' in line)
        self.assertLess(begun, started)
        self.assertTrue([line for line in lines if f'trace of 3 machines written to: {self.traces}/{self.name} (' in line], lines)
        verdict = self.verdict()
        self.assertEqual([part['machine'] for part in verdict['machines']], ['local', 'arm', 'base'])
        self.assertEqual([part['folder'] for part in verdict['machines']], ['local', 'arm', 'base'])
        self.assertEqual(verdict['complete'], all(self.verdict(part)['complete'] for part in ('local', 'arm', 'base')))
        self.assertTrue(verdict['complete'], (verdict, lines))  # that nothing was to be recorded here is no problem
        self.assertTrue(self.verdict('local')['nothing_to_record'])
        self.assertFalse([line for line in lines if 'incomplete' in line], lines)
        for host in self.hosts:  # they share a clock, so the truth is known
            clock = json.loads((self.traces / self.name / host.name / 'clock.json').read_text())
            self.assertLessEqual(abs(clock['offset_ns']), clock['uncertainty_ns'], clock)
            self.assertLessEqual(abs(clock['monotonic']['offset_ns']), clock['uncertainty_ns'], clock)
            self.assertGreater(clock['round_trips'], 32)
        report = self.report()
        hosts = {process['name']: process['host'] for process in report['processes'] if process['name'] in ('talker', 'listener')}
        self.assertEqual(hosts, {'talker': 'arm', 'listener': 'base'})
        heard = [one for one in report['subscriptions'] if (one['topic'], one['node']) == ('/chatter', '/listener')]
        self.assertEqual(len(heard), 1)
        self.assertGreater(heard[0]['received'], 0, heard)
        for host in self.hosts:
            self.assertEqual(self.recordings_there(host), [])
            self.assert_no_session(host)

    def test_recordings_stay_there(self):
        launch = self.start_nodes(f'<trace session-name="{self.name}" collect="none"/>')
        self.assertEqual(self.interrupt(launch), 0, launch.lines.seen)
        for host in self.hosts:
            there = f'{host.folder}/.ros/tracing/{self.name}-{host.name}'
            launch.lines.wait_for(f"the recording of machine '{host.name}' stays there: {there}")
            self.assertTrue((Path(there) / 'verdict.json').is_file())
            self.assertFalse((self.traces / self.name / host.name).exists())
        parts = {part['machine']: part for part in self.verdict()['machines']}
        self.assertEqual(parts['arm']['left_there'], f'{self.hosts[0].folder}/.ros/tracing/{self.name}-arm')
        self.assertFalse(self.verdict()['complete'])  # what is not here is not known here

    def test_one_machine(self):
        launch = self.start_nodes(f'<trace session-name="{self.name}" machine="arm"/>')
        self.assertEqual(self.interrupt(launch), 0, launch.lines.seen)
        self.assertEqual([part['machine'] for part in self.verdict()['machines']], ['arm'])
        self.assertEqual({process['host'] for process in self.report()['processes']}, {'arm'})
        self.assertEqual(self.recordings_there(self.hosts[1]), [])

    def test_this_machine(self):
        launch = self.start_nodes(f'<trace session-name="{self.name}" machine="local"/>', '<node pkg="demo_nodes_cpp" exec="talker" name="here"/>')
        self.assertEqual(self.interrupt(launch), 0, launch.lines.seen)
        self.assertNotIn('machines', self.verdict())
        for host in self.hosts:
            self.assertEqual(self.recordings_there(host), [])

    def test_a_machine_that_is_used_later_is_told_in_the_verdict(self):
        launch = self.start(self.file(
            f'<machine name="arm" connect="{self.hosts[0].connect()}"/><trace session-name="{self.name}"/><executable name="here" cmd="sleep 1000"/>'
            '<timer period="0.1"><executable name="late" machine="arm" cmd="echo late" output="screen"/></timer>'))
        launch.lines.wait_for('[arm:late')
        self.interrupt(launch)
        self.assertTrue([line for line in launch.lines.seen
                         if "machine 'arm' was not in use when the trace began: its processes are not recorded" in line], launch.lines.seen)
        verdict = self.verdict()
        self.assertFalse(verdict['complete'])
        self.assertIn("machine 'arm' was first used when the trace had begun, so these processes are not recorded: late", verdict['absent'])

    def test_a_machine_that_is_lost_is_told_in_the_verdict(self):
        launch = self.start_nodes(f'<trace session-name="{self.name}"/>', keepalive=1.5)
        self.kill_agent(self.hosts[0])
        launch.lines.wait_for("the connection to machine 'arm' is lost: ")
        self.interrupt(launch)
        verdict = self.verdict()
        self.assertFalse(verdict['complete'])
        parts = {part['machine']: part for part in verdict['machines']}
        self.assertNotIn('folder', parts['arm'])
        self.assertEqual(parts['arm']['left_there'], f'{self.hosts[0].folder}/.ros/tracing/{self.name}-arm')
        self.assertIn("the connection to machine 'arm' is lost: ", parts['arm']['problem'])
        self.assertIn(f'{self.hosts[0].folder}/.ros/tracing/{self.name}-arm', parts['arm']['problem'])
        self.assertEqual(parts['base']['folder'], 'base')
        self.assert_nothing_left('lost machine')
        # Its guardian has ended the session there, and judged what it holds.
        self.assert_no_session(self.hosts[0])
        self.wait_for_verdict(self.hosts[0])

    def test_a_connection_that_is_cut_while_files_come_leaves_nothing_that_looks_whole(self):
        launch = self.start_nodes(f'<trace session-name="{self.name}"/>', keepalive=1000, cable=self.cable('cut'))
        self.interrupt(launch)
        verdict = self.verdict()
        self.assertFalse(verdict['complete'])
        for host, part in zip(self.hosts, verdict['machines'][1:]):
            there = f'{host.folder}/.ros/tracing/{self.name}-{host.name}'
            self.assertEqual((part['machine'], part['complete'], part.get('left_there')), (host.name, False, there), launch.lines.seen)
            self.assertRegex(part['problem'], f"^the recording of machine '{host.name}' could not be fetched: the connection to machine "
                                              f"'{host.name}' is lost: .*; it is in '{there}' there$")
            self.assertNotIn('folder', part)
            self.assertTrue((Path(there) / 'verdict.json').is_file())
            self.assert_no_session(host)
        self.assertEqual(sorted(path.name for path in (self.traces / self.name).iterdir()), ['local', 'verdict.json'])
        self.assertIn('the trace of all machines is incomplete', '\n'.join(launch.lines.seen))

    def test_a_launch_that_is_killed_while_files_come_leaves_nothing_that_looks_whole(self):
        launch = self.start_nodes(f'<trace session-name="{self.name}"/>', keepalive=1000, cable=self.cable('stall'))
        self.kill_launcher_at(launch, signal.SIGINT, "fetching the recording of machine 'arm': ")
        verdict = self.verdict()
        self.assertFalse(verdict['complete'])
        for host in self.hosts:
            there = f'{host.folder}/.ros/tracing/{self.name}-{host.name}'
            self.assertIn(f"the launch has not ended the recording of machine '{host.name}', which is in '{there}' there", verdict['absent'])
            self.assertFalse((self.traces / self.name / host.name).exists())
            self.assertTrue((Path(there) / 'verdict.json').is_file())
            self.assert_no_session(host)

    def test_a_second_interrupt_leaves_the_recordings_there(self):
        launch = self.start_nodes(f'<trace session-name="{self.name}"/>', keepalive=1000, cable=self.cable('stall'))
        launch.send_signal(signal.SIGINT)
        launch.lines.wait_for("fetching the recording of machine 'arm': ")
        self.interrupt(launch)
        verdict = self.verdict()
        self.assertFalse(verdict['complete'])
        for host in self.hosts:
            there = f'{host.folder}/.ros/tracing/{self.name}-{host.name}'
            self.assertIn(f"the recording of machine '{host.name}' could not be fetched: the launch was to end at once; it is in '{there}' there",
                          verdict['absent'])
            self.assertFalse((self.traces / self.name / host.name).exists())

    def latency_of_chatter(self):
        report = self.report()
        heard = next(one for one in report['subscriptions'] if (one['topic'], one['node']) == ('/chatter', '/listener'))
        return report['clocks'], heard['latency']

    def test_times_are_those_of_the_clock_of_the_launch(self):
        """The hosts share a clock. So the truth is known when the one of a recording is moved, as if it had been set wrong there."""
        self.hosts[0].link(self.hosts[1])
        launch = self.start_nodes(f'<trace session-name="{self.name}"/>')
        launch.lines.wait_for('[base:listener-2] [INFO]')
        self.assertEqual(self.interrupt(launch), 0, launch.lines.seen)
        clocks, truth = self.latency_of_chatter()
        self.assertEqual(clocks, [])
        self.assertGreater(truth['count'], 0)
        self.move_clock('arm', 3_700_000_000)
        self.move_clock('base', -8_000_000_000)
        clocks, latency = self.latency_of_chatter()
        self.assertEqual(len(clocks), 2, clocks)
        self.assertRegex(clocks[0], r'^the clock of arm was 3\.(699|700)\d{3} s ahead of that of the launch')
        self.assertRegex(clocks[1], r'^the clock of base was (7\.999|8\.000)\d{3} s behind that of the launch')
        self.assertEqual(latency['count'], truth['count'])
        files = [self.traces / self.name / host.name / 'clock.json' for host in self.hosts]
        error = sum(json.loads(file.read_text())['uncertainty_ns'] for file in files)
        for figure in ('min_ns', 'max_ns'):
            self.assertLessEqual(abs(latency[figure] - truth[figure]), error, (latency, truth))
        for file in files:
            file.unlink()
        clocks, latency = self.latency_of_chatter()  # as recorded
        self.assertEqual(clocks, [])
        self.assertNotEqual(latency, truth)

    def move_clock(self, machine, nanoseconds):
        """Of the recording, which says when the clock of its events began."""
        for path in (self.traces / self.name / machine).rglob('metadata'):
            text = path.read_bytes()
            moved = re.sub(rb'(\n\s*offset = )(\d+);', lambda found: found[1] + str(int(found[2]) + nanoseconds).encode() + b';', text)
            self.assertNotEqual(moved, text)
            self.assertEqual(len(moved), len(text))
            path.write_bytes(moved)

    def test_sessions_end_when_the_launcher_is_killed(self):
        launch = self.start_nodes(f'<trace session-name="{self.name}"/>')
        self.kill_and_look(launch, self.descendants(launch.pid))

    def test_sessions_end_when_launcher_guardian_and_agents_are_killed(self):
        launch = self.start_nodes(f'<trace session-name="{self.name}"/>')
        self.kill_and_look(launch, [launch.pid, *self.descendants(launch.pid), *self.agents(self.hosts[0]), *self.agents(self.hosts[1])])

    def test_a_recording_is_judged_when_the_guardian_of_the_launch_ends_its_session_daemon(self):
        """As with `sudo -u` or `ip netns exec`: what the connecting command starts is below the launch, whose guardian ends it."""
        launch = self.start_nodes(f'<trace session-name="{self.name}"/>', connect=Host.enter)
        self.kill_and_look(launch, [launch.pid, *self.descendants(launch.pid), *self.agents(self.hosts[0]), *self.agents(self.hosts[1])])

    def kill_and_look(self, launch, processes):
        for pid in processes:
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                continue
        self.assert_nothing_left('killed launch')
        launch.wait(PATIENCE)
        for host in self.hosts:
            self.assert_no_session(host)
            self.wait_for_verdict(host)
        self.assertFalse(self.verdict()['complete'])
        self.wait_for_file(self.traces / self.name / 'local/verdict.json')


if __name__ == '__main__':
    unittest.main()
