# SPDX-License-Identifier: Apache-2.0
"""What a user does with a launch that runs: steering, Ctrl-Z, another reading of the file."""

import json
import os
import signal
import time
import unittest
from pathlib import Path

from machine_hosts import MARK, PATIENCE, MachinesTest


class MachineSteering(MachinesTest):
    def setUp(self):
        super().setUp()
        self.arm = self.host('arm')
        self.machine = f'<machine name="arm" connect="{self.arm.connect()}" keepalive="1"/>\n'

    def start_two(self):
        launch = self.start(self.file(self.machine + f'''
            <executable name="there" machine="arm" output="both"
                cmd="sh -c 'trap &quot;echo got it&quot; USR1; echo ready; while :; do sleep 0.1; done'">
              <env name="{MARK}" value="{self.mark}"/>
            </executable>
            <executable name="here" output="screen" cmd="sh -c 'echo ready; exec sleep 1000'"/>'''))
        launch.lines.wait_for('[arm:there-1] ready')
        launch.lines.wait_for('[here-2] ready')
        return launch

    def processes(self, launch):
        answer = json.loads(self.launch('ps', '--launch', launch.pid, '--json').stdout)
        return {process['name']: process for process in answer['launches'][0]['processes']}

    def test_commands_reach_processes_of_all_machines(self):
        launch = self.start_two()
        chosen = ('--launch', launch.pid)
        there = self.processes(launch)['there-1']
        self.assertEqual((there['machine'], there['state'], 'pid' in there, there['pid_there'] > 0), ('arm', 'running', False, True))
        self.assertIn('pid', self.processes(launch)['here-2'])
        self.assertIn('running on arm', self.launch('ps', *chosen).stdout)
        self.assertIn('[arm:there-1] ready', self.launch('logs', 'there', *chosen).stdout)
        for command in 'gdb', 'stack':
            refused = self.launch(command, 'there', *chosen)
            self.assertEqual((refused.returncode, refused.stdout), (
                1, f"launch {command}: error: 'there' runs on machine 'arm', which a debugger here does not reach\n"))
        refused = self.launch('attach', 'there', *chosen)
        self.assertEqual((refused.returncode, refused.stdout), (
            1, "launch attach: error: 'there-1' runs on machine 'arm', whose terminals are not reached\n"))
        self.launch('signal', 'there', 'USR1', *chosen)
        launch.lines.wait_for('[arm:there-1] got it')
        self.assertEqual(self.launch('restart', 'there', *chosen).returncode, 0)
        self.assertNotEqual(self.processes(launch)['there-1']['pid_there'], there['pid_there'])
        self.assertEqual(self.launch('stop', 'there', *chosen).returncode, 0)
        self.assertEqual(self.processes(launch)['there-1']['state'], 'ended')
        self.assertEqual(self.launch('start', 'there', *chosen).returncode, 0)
        self.assertEqual(self.processes(launch)['there-1']['state'], 'running')

    def test_a_launch_that_is_stopped_does_not_lose_its_machines(self):
        launch = self.start_two()
        launch.send_signal(signal.SIGTSTP)
        self.wait_for_state(launch.pid, 'T')
        left = [pid for pid, words in self.marked().items() if 'trap' in words]
        for pid in left:
            self.wait_for_state(pid, 'T')
        time.sleep(4)  # longer than the agent waits for a launcher that is silent
        self.assertEqual([pid for pid, words in self.marked().items() if 'trap' in words], left)
        os.kill(launch.pid, signal.SIGCONT)
        self.launch('signal', 'there', 'USR1', '--launch', launch.pid)
        launch.lines.wait_for('[arm:there-1] got it')
        self.assertEqual(self.processes(launch)['there-1']['state'], 'running')

    def wait_for_state(self, pid, state):
        end = time.monotonic() + PATIENCE
        while Path(f'/proc/{pid}/stat').read_text().rpartition(')')[2].split()[0] != state:
            self.assertLess(time.monotonic(), end)
            time.sleep(0.05)

    def test_another_reading_moves_processes(self):
        launch = self.start_two()
        self.file(self.machine + '''
            <executable name="there" output="screen" cmd="sh -c 'echo now here; exec sleep 1000'"/>
            <executable name="here" machine="arm" output="screen" cmd="sh -c 'echo now there; exec sleep 1000'"/>''')
        done = self.launch('reload', '--launch', launch.pid)
        self.assertEqual(done.returncode, 0, done.stdout)
        launch.lines.wait_for('] now here')
        launch.lines.wait_for('] now there')
        moved = {name.rpartition('-')[0]: process.get('machine') for name, process in self.processes(launch).items() if process['state'] == 'running'}
        self.assertEqual(moved, {'there': None, 'here': 'arm'})
        self.assert_nothing_left('moved')

    def test_a_guardian_there_that_is_killed_is_missed(self):
        launch = self.start_two()
        for entry in Path('/proc').iterdir():
            if entry.name.isdigit():
                try:
                    words = (entry / 'cmdline').read_bytes().split(b'\0')
                    inside = os.readlink(entry / 'ns/uts') == os.readlink(f'/proc/{self.arm._first}/ns/uts')
                except OSError:
                    continue
                if inside and words[0] == b'launch-guardian' and b'--' in words:
                    os.kill(int(entry.name), signal.SIGKILL)
        launch.send_signal(signal.SIGINT)
        launch.wait(PATIENCE)
        self.assert_nothing_left('guardian there')


if __name__ == '__main__':
    unittest.main()
