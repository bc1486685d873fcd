# SPDX-License-Identifier: Apache-2.0
"""Snapshots of a flight recorder, one after another: each uses up a sub-buffer of each processor, and still all have the names of objects."""

import json
import signal
import subprocess
import unittest

from own_launches import LAUNCH, PATIENCE, OwnLaunches


class RepeatedSnapshots(OwnLaunches):
    def setUp(self):
        super().setUp()
        self.environment['ROS_TRACE_DIR'] = str(self.folder)
        self.name = f'snapshots-{self.folder.name}'
        (self.folder / 'system.launch.xml').write_text(
            f'<launch><trace session-name="{self.name}" snapshot-on-signal="SIGUSR1"/>'
            '<node pkg="demo_nodes_cpp" exec="talker" output="screen"/></launch>')
        self.launched = self.start(LAUNCH, 'system.launch.xml')
        self.launched.lines.wait_for('[talker-1] [INFO]')

    def names(self, snapshot):
        report = json.loads(subprocess.run([LAUNCH, 'report', snapshot, '--json'], check=True, stdout=subprocess.PIPE,
                                           timeout=PATIENCE, env=self.environment).stdout)
        self.assertEqual(report['losses'], [], snapshot)
        return {node['name'] for node in report['nodes']}

    def interrupt(self):
        self.launched.send_signal(signal.SIGINT)
        self.assertEqual(self.launched.wait(PATIENCE), 0)

    def test_on_a_signal(self):
        for number in range(1, 8):
            self.launched.send_signal(signal.SIGUSR1)
            self.launched.lines.wait_for('snapshot written to: ', number)
            self.launched.lines.wait_for('[talker-1] [INFO]', 1 + number)
        self.interrupt()
        snapshots = sorted(path for path in (self.folder / self.name).iterdir() if path.is_dir())
        self.assertEqual(len(snapshots), 7, self.launched.lines.seen)
        for snapshot in snapshots:
            self.assertIn('/talker', self.names(snapshot))

    def test_by_hand(self):
        for number in range(2):
            taken = subprocess.run([LAUNCH, 'trace', 'record_snapshot', self.name], stdout=subprocess.PIPE, text=True, check=True,
                                   timeout=PATIENCE, env=self.environment).stdout
            self.launched.lines.wait_for('[talker-1] [INFO]', 2 + number)
        self.interrupt()
        snapshot = next(line.partition(': ')[2] for line in taken.splitlines() if line.startswith('snapshot written to: '))
        self.assertIn('/talker', self.names(snapshot))


if __name__ == '__main__':
    unittest.main()
