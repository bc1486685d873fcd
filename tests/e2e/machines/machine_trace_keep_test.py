# SPDX-License-Identifier: Apache-2.0
"""A trace of several machines whose connections are cut and made again: on_disconnect="keep"."""

import json
import signal
import subprocess
import unittest
from pathlib import Path

from machine_hosts import LAUNCH, PATIENCE
from traced_machines import TracedMachines

# A connection that ends when the first file of a recording comes through it, once.
CUT_ONCE = '''
import os, subprocess, sys
agent = subprocess.Popen(sys.argv[2:], stdout=subprocess.PIPE)
while chunk := agent.stdout.read1(65536):
    begin, file, _ = chunk.partition(b'ust/uid')
    if file and not os.path.exists(sys.argv[1]):
        open(sys.argv[1], 'w').close()
        sys.stdout.buffer.write(begin + file)
        sys.stdout.buffer.flush()
        os._exit(1)
    sys.stdout.buffer.write(chunk)
    sys.stdout.buffer.flush()
'''


class MachineTraceKeep(TracedMachines):
    def assert_whole(self, launch):
        """The recordings of both machines are here, and nothing is missing of what the talker has said."""
        verdict = self.verdict()
        self.assertTrue(verdict['complete'], (verdict, launch.lines.seen))
        self.assertEqual([part['folder'] for part in verdict['machines']], ['local', 'arm', 'base'])
        said = sum('[talker]: Publishing: ' in line for line in launch.lines.seen)
        report = json.loads(subprocess.run([LAUNCH, 'report', self.traces / self.name, '--json'], check=True, stdout=subprocess.PIPE,
                                           timeout=PATIENCE, env=self.environment).stdout)
        chatter, = (topic for topic in report['topics'] if topic['name'] == '/chatter')
        self.assertGreaterEqual(said, 2, launch.lines.seen)
        self.assertIn(chatter['published'] - said, (0, 1))  # the last word may have been cut off by the end
        for host in self.hosts:
            self.assertEqual(self.recordings_there(host), [])
            self.assert_no_session(host)

    def test_a_cut_while_it_records_loses_nothing(self):
        launch = self.start_nodes(f'<trace session-name="{self.name}"/>', machine='on_disconnect="keep"')
        self.hosts[0].cut()
        launch.lines.wait_for("the connection to machine 'arm' is lost: ")
        self.hosts[0].open_door()
        launch.lines.wait_for("machine 'arm' is back after ")
        launch.lines.wait_for('[talker]: Publishing: ', 3)
        self.assertEqual(self.interrupt(launch), 0, launch.lines.seen)
        self.assert_whole(launch)

    def test_a_cut_while_the_recording_comes_home_loses_nothing(self):
        path = self.folder / 'cut_once.py'
        path.write_text(CUT_ONCE)
        launch = self.start_nodes(f'<trace session-name="{self.name}"/>', machine='on_disconnect="keep"',
                                  cable=f'/usr/bin/python3 {path} {self.folder}/was_cut')
        launch.lines.wait_for('[talker]: Publishing: ', 2)
        self.assertEqual(self.interrupt(launch), 0, launch.lines.seen)
        self.assertTrue(Path(self.folder / 'was_cut').exists())
        self.assertTrue([line for line in launch.lines.seen if ' is back after ' in line], launch.lines.seen)
        self.assert_whole(launch)

    def test_a_machine_that_is_away_at_the_end_is_told_in_the_verdict(self):
        launch = self.start_nodes(f'<trace session-name="{self.name}"/>', machine='on_disconnect="keep" keep_for="8"')
        self.hosts[0].cut()
        launch.lines.wait_for("the connection to machine 'arm' is lost: ")
        launch.send_signal(signal.SIGINT)
        launch.lines.wait_for("machine 'arm' does not come back: there was no connection for ")
        self.assertEqual(launch.wait(PATIENCE), 3)
        verdict = self.verdict()
        self.assertFalse(verdict['complete'])
        parts = {part['machine']: part for part in verdict['machines']}
        self.assertNotIn('folder', parts['arm'])
        self.assertEqual(parts['arm']['left_there'], f'{self.hosts[0].folder}/.ros/tracing/{self.name}-arm')
        self.assertIn('folder', parts['base'])
        self.assert_nothing_left('a machine that was away at the end')
        self.wait_for_file(self.hosts[0].folder / '.ros/tracing' / f'{self.name}-arm' / 'verdict.json')


if __name__ == '__main__':
    unittest.main()
