# SPDX-License-Identifier: Apache-2.0
"""A snapshot of all machines for the same moment, whoever has the reason for it; also when a machine is lost."""

import json
import os
import re
import signal
import subprocess
import unittest
from pathlib import Path

from machine_hosts import LAUNCH, PATIENCE
from traced_machines import TracedMachines


class MachineSnapshot(TracedMachines):
    def snapshots(self):
        return sorted(path.name for path in (self.traces / self.name).glob('snapshot-*'))

    def taken(self, launch):
        """The folder of the first snapshot, when it is whole."""
        line = launch.lines.wait_for(f'written to: {self.traces}/{self.name}/snapshot-')
        return re.search(r'(snapshot-\d{8}-\d{6}-\d+)', line)[1]

    def by_hand(self):
        return subprocess.run([LAUNCH, 'trace', 'record_snapshot', self.name], cwd=self.folder, env=self.environment, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True, check=False, timeout=PATIENCE)

    def process(self, name):
        found = [pid for pid, command in self.marked().items() if command.split(' ')[0].endswith(f'/{name}')]
        self.assertEqual(len(found), 1, self.marked())
        return found[0]

    def assert_of_all(self, snapshot, reasons):
        verdict = self.verdict(snapshot)
        self.assertEqual(verdict['reasons'], reasons)
        self.assertEqual([part.get('folder') for part in verdict['machines']], ['local', 'arm', 'base'], verdict)
        parts = {part: self.verdict(snapshot, part) for part in ('local', 'arm', 'base')}
        for part in parts.values():
            self.assertEqual(part['reasons'], reasons)
        self.assertEqual(verdict['complete'], all(part['complete'] for part in parts.values()), parts)
        begin = {name: part['begin_ns'] for name, part in parts.items() if part.get('begin_ns')}
        self.assertIn('arm', begin, parts)
        self.assertIn('base', begin, parts)
        for host in self.hosts:
            clock = json.loads((self.traces / self.name / snapshot / host.name / 'clock.json').read_text())
            self.assertLessEqual(abs(clock['offset_ns']), clock['uncertainty_ns'], clock)
        return verdict

    def hosts_in(self, snapshot):
        report = json.loads(subprocess.run([LAUNCH, 'report', self.traces / self.name / snapshot, '--json'], check=True, stdout=subprocess.PIPE,
                                           timeout=PATIENCE, env=self.environment).stdout)
        return {process['name']: process['host'] for process in report['processes'] if process['name'] in ('talker', 'listener')}

    def assert_nothing_there(self):
        for host in self.hosts:
            self.assertEqual(self.recordings_there(host), [], self.left_in(host))
            self.assert_no_session(host)

    def test_a_crash_on_one_machine(self):
        launch = self.start_nodes(f'<trace session-name="{self.name}" snapshot-on-crash="true"/>')
        launch.lines.wait_for('[base:listener-2]')
        os.kill(self.process('listener'), signal.SIGSEGV)
        snapshot = self.taken(launch)
        self.interrupt(launch)
        verdict = self.assert_of_all(snapshot, ['base:listener-2 died of SIGSEGV'])
        self.assertEqual(self.snapshots(), [snapshot])
        self.assertGreater(verdict['time_ns'], 1_600_000_000 * 10**9)
        self.assertEqual(self.hosts_in(snapshot), {'talker': 'arm', 'listener': 'base'})
        self.assertTrue([line for line in launch.lines.seen if f'snapshots are in: {self.traces}/{self.name}' in line], launch.lines.seen)
        self.assertEqual(sorted(path.name for path in (self.traces / self.name).iterdir()), [snapshot])
        self.assert_nothing_there()

    def test_a_crash_here(self):
        os.mkfifo(self.folder / 'go')
        launch = self.start_nodes(f'<trace session-name="{self.name}" snapshot-on-crash="true"/>',
                                  '<executable name="bad" cmd="sh -c \'read x &lt; go; exit 3\'" cwd="$(dirname)"/>')
        launch.lines.wait_for('[bad-3]')
        (self.folder / 'go').write_text('x\n')
        snapshot = self.taken(launch)
        self.interrupt(launch)
        self.assert_of_all(snapshot, ['bad-3 ended with exit code 3'])

    def test_by_hand(self):
        launch = self.start_nodes(f'<trace session-name="{self.name}" snapshot-mode="true"/>')
        first = self.by_hand()
        second = self.by_hand()
        for result in (first, second):
            self.assertEqual(result.returncode, 0, result)
            self.assertRegex(result.stdout, f'snapshot written to: {self.traces}/{self.name}/snapshot-')
        self.assertEqual(len(self.snapshots()), 2)
        for snapshot in self.snapshots():
            self.assertTrue(self.assert_of_all(snapshot, ['launch trace record_snapshot'])['complete'])
        report = json.loads(subprocess.run([LAUNCH, 'report', self.traces / self.name, '--json'], check=True, stdout=subprocess.PIPE,
                                           timeout=PATIENCE, env=self.environment).stdout)
        self.assertEqual({process['host'] for process in report['processes'] if process['name'] == 'talker'}, {'arm'})
        self.interrupt(launch)
        self.assert_nothing_there()

    def test_a_late_message(self):
        self.hosts[0].link(self.hosts[1])
        launch = self.start_nodes(f'<trace session-name="{self.name}" snapshot-on-late-message="0.001" snapshot-limit="2"/>')
        for number in range(3):  # each message is one
            launch.lines.wait_for(f'-{number} (base: a message was taken after more than 0.001 ms)')
        self.interrupt(launch)
        self.assertEqual(len(self.snapshots()), 2)
        for snapshot in self.snapshots():
            self.assert_of_all(snapshot, ['base: a message was taken after more than 0.001 ms'])
        self.assert_nothing_there()

    def test_a_lost_machine_is_told_and_is_a_reason(self):
        launch = self.start_nodes(f'<trace session-name="{self.name}" snapshot-on-crash="true"/>', keepalive=1.5)
        self.kill_agent(self.hosts[0])
        snapshot = self.taken(launch)
        verdict = self.verdict(snapshot)
        self.assertEqual(verdict['reasons'], ["machine 'arm' is lost"])
        self.assertFalse(verdict['complete'])
        parts = {part['machine']: part for part in verdict['machines']}
        self.assertNotIn('folder', parts['arm'])
        self.assertRegex(parts['arm']['problem'], "^the connection to machine 'arm' is lost: .*: no snapshot of machine 'arm'$")
        self.assertEqual(parts['base']['folder'], 'base')
        result = self.by_hand()
        self.assertEqual(result.returncode, 0, result)
        self.assertIn('warning: the snapshot is incomplete, see ', result.stderr)
        self.interrupt(launch)
        self.assertEqual(len(self.snapshots()), 2)
        there = f'{self.hosts[0].folder}/.ros/tracing/{self.name}-arm'
        self.assertTrue([line for line in launch.lines.seen if f"what it still has of snapshots is in '{there}' there" in line], launch.lines.seen)
        self.assert_no_session(self.hosts[0])

    def test_one_other_machine_and_a_signal(self):
        launch = self.start_nodes(f'<trace session-name="{self.name}" snapshot-on-signal="SIGUSR1" machine="arm"/>')
        launch.send_signal(signal.SIGUSR1)
        snapshot = self.taken(launch)
        self.interrupt(launch)
        verdict = self.verdict(snapshot)
        self.assertEqual((verdict['reasons'], [part['machine'] for part in verdict['machines']]), (['SIGUSR1'], ['arm']))
        self.assertEqual(self.hosts_in(snapshot), {'talker': 'arm'})

    def test_snapshots_stay_there(self):
        launch = self.start_nodes(f'<trace session-name="{self.name}" snapshot-mode="true" snapshot-limit="1" collect="none"/>')
        self.by_hand()
        self.by_hand()
        self.interrupt(launch)
        self.assertEqual(len(self.snapshots()), 1)
        verdict = self.verdict(self.snapshots()[0])
        self.assertFalse(verdict['complete'])
        for host, part in zip(self.hosts, verdict['machines'][1:]):
            self.assertEqual([str(path) for path in (host.folder / '.ros/tracing').glob(f'{self.name}-{host.name}/snapshot-*')],
                             [part['left_there']])
            self.assertTrue((Path(part['left_there']) / 'verdict.json').is_file())

    def test_a_launch_that_is_killed_while_files_come_leaves_nothing_that_looks_whole(self):
        launch = self.start_nodes(f'<trace session-name="{self.name}" snapshot-on-signal="SIGUSR1"/>', keepalive=1000, cable=self.cable('stall'))
        self.kill_launcher_at(launch, signal.SIGUSR1, "fetching the snapshot of machine 'arm': ")
        verdict = self.verdict(self.snapshots()[0])
        self.assertFalse(verdict['complete'])
        self.assertFalse((self.traces / self.name / self.snapshots()[0] / 'arm').exists())
        self.assertRegex(verdict['machines'][1]['problem'], "^the launch has not fetched the snapshot of machine 'arm', which is in '.*' there$")
        for host in self.hosts:
            self.assert_no_session(host)

    def test_without_a_reason_nothing_is_written(self):
        launch = self.start_nodes(f'<trace session-name="{self.name}" snapshot-on-crash="true"/>')
        self.assertEqual(self.interrupt(launch), 0, launch.lines.seen)
        self.assertTrue([line for line in launch.lines.seen if 'no trace was written: no snapshot was taken' in line], launch.lines.seen)
        self.assertFalse((self.traces / self.name).exists())
        self.assert_nothing_there()


if __name__ == '__main__':
    unittest.main()
