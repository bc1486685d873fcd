# SPDX-License-Identifier: Apache-2.0
"""No process survives on any machine, whatever dies: launcher, guardian, agent, connection, or several at once."""

import os
import random
import signal
import time
import unittest
from pathlib import Path

from machine_hosts import MARK, PATIENCE, MachinesTest

# Trees of processes as programs make them; each says that it is ready, and ends on no signal at once but SIGKILL.
TREES = {
    'plain': "echo ready; exec sleep 1000",
    'child': "sleep 1000 &amp; echo ready; wait",
    'daemon': "setsid sleep 1000 &amp; (setsid sh -c 'sleep 1000 &amp;' &amp;) ; echo ready; exec sleep 1000",
    'deaf': "trap : INT TERM HUP; sh -c 'trap : INT TERM HUP; while :; do sleep 0.2; done' &amp; echo ready; while :; do sleep 0.2; done",
    'orphan': "(sleep 1000 &amp;) ; echo ready; exec sleep 1000",
}


class MachineEnd(MachinesTest):
    def setUp(self):
        super().setUp()
        self.hosts = [self.host('arm'), self.host('base')]

    def start_trees(self, names, more=''):
        text = ''.join(f'<machine name="{host.name}" connect="{host.connect()}" keepalive="1.5"/>\n' for host in self.hosts)
        text += f'<set_env name="{MARK}" value="{self.mark}"/>\n'
        for number, (name, machine) in enumerate(names):
            text += (f'<executable name="{name}{number}" machine="{machine}" output="screen" shell="false" sigterm_timeout="0.5" '
                     f'sigkill_timeout="0.5" cmd="sh -c &quot;{TREES[name]}&quot;"/>\n')
        launch = self.start(self.file(text + more))
        for number, (name, machine) in enumerate(names):
            where = '' if machine == 'local' else f'{machine}:'
            launch.lines.wait_for(f'[{where}{name}{number}-{number + 1}] ready')
        return launch

    def parts(self, launch):
        """The processes that hold the launch, by what they are."""
        found = {'guardian': [launch.pid], 'launcher': [], 'agent': [], 'guardian there': [], 'connection': []}
        parents = {}
        for entry in Path('/proc').iterdir():
            if entry.name.isdigit():
                try:
                    stat = (entry / 'stat').read_text()
                    parents[int(entry.name)] = int(stat.rpartition(')')[2].split()[1])
                except OSError:
                    continue

        def below(pid):
            while pid in parents and pid != launch.pid:
                pid = parents[pid]
            return pid == launch.pid

        for pid in parents:
            try:
                program = os.readlink(f'/proc/{pid}/exe').rpartition('/')[2]
                words = Path(f'/proc/{pid}/cmdline').read_bytes().split(b'\0')
            except OSError:
                continue
            if program == 'launch-agent' and self.of_hosts(pid):
                found['agent'].append(pid)
            elif program == 'launch-guardian' and b'agent' in words and self.of_hosts(pid):
                found['guardian there'].append(pid)
            elif program == 'launch' and below(pid) and pid != launch.pid:
                found['launcher'].append(pid)
            elif b'enter' in words and any(f'{host.folder}/door'.encode() in words for host in self.hosts) and below(pid):
                found['connection'].append(pid)
        return found

    def of_hosts(self, pid):
        try:
            return os.readlink(f'/proc/{pid}/ns/uts') in [os.readlink(f'/proc/{host._first}/ns/uts') for host in self.hosts]
        except OSError:
            return False

    def test_ways_to_die(self):
        ways = {'interrupt': lambda parts: os.kill(parts['guardian'][0], signal.SIGINT),
                'launcher': lambda parts: self.kill(parts, 'launcher'),
                'guardian': lambda parts: self.kill(parts, 'guardian'),
                'launcher and guardian': lambda parts: self.kill(parts, 'launcher', 'guardian'),
                'agents': lambda parts: self.kill(parts, 'agent'),
                'one agent': lambda parts: os.kill(parts['agent'][0], signal.SIGKILL),
                'launcher, guardian and agents': lambda parts: self.kill(parts, 'launcher', 'guardian', 'agent'),
                'launcher and connections': lambda parts: self.kill(parts, 'launcher', 'connection')}
        seed = int(os.environ.get('MACHINE_END_SEED', '1'))
        rounds = int(os.environ.get('MACHINE_END_ROUNDS', '1'))
        choose = random.Random(seed)
        for number in range(rounds):
            for way, kill in ways.items():
                with self.subTest(way=way, number=number):
                    names = [(choose.choice(list(TREES)), choose.choice(['arm', 'base', 'local'])) for _ in range(5)] + [('plain', 'arm'), ('child', 'base')]
                    launch = self.start_trees(names)
                    parts = self.parts(launch)
                    self.assertEqual([len(parts['launcher']), len(parts['agent'])], [1, 2], parts)
                    kill(parts)
                    if way in ('agents', 'one agent'):
                        # What runs elsewhere goes on.
                        launch.lines.wait_for(' is lost: ')
                        launch.send_signal(signal.SIGINT)
                    self.assert_nothing_left((way, names))
                    launch.wait(PATIENCE)

    @staticmethod
    def kill(parts, *names):
        for name in names:
            for pid in parts[name]:
                try:
                    os.kill(pid, signal.SIGKILL)
                except ProcessLookupError:
                    continue

    def test_a_lost_connection_is_told_with_what_ran_there(self):
        launch = self.start_trees([('plain', 'arm'), ('child', 'arm'), ('plain', 'base')])
        parts = self.parts(launch)
        arm = [pid for pid in parts['agent'] if os.readlink(f'/proc/{pid}/ns/uts') == os.readlink(f'/proc/{self.hosts[0]._first}/ns/uts')]
        os.kill(arm[0], signal.SIGKILL)
        line = launch.lines.wait_for("the connection to machine 'arm' is lost: ")
        self.assertIn('what ran there: plain0-1, child1-2; the agent there ends it', line)
        launch.lines.wait_for("[arm:plain0-1]: process is lost with machine 'arm'")
        launch.lines.wait_for("[arm:child1-2]: process is lost with machine 'arm'")
        self.assertIsNone(launch.poll())  # base goes on
        launch.send_signal(signal.SIGINT)
        self.assertEqual(launch.wait(PATIENCE), 3)
        self.assert_nothing_left('one agent')

    def test_a_handler_starts_something_in_place_of_what_was_lost(self):
        launch = self.start_trees([('plain', 'arm'), ('plain', 'base')], f'''
          <on_machine_lost machine="base"><log message="base is lost"/></on_machine_lost>
          <on_machine_lost machine="arm">
            <log message="$(var event.machine) is lost with $(var event.processes): $(var event.reason)"/>
            <executable name="instead" cmd="sh -c 'echo ready; exec sleep 1000'" output="screen"/>
          </on_machine_lost>''')
        agents = self.parts(launch)['agent']
        arm = [pid for pid in agents if os.readlink(f'/proc/{pid}/ns/uts') == os.readlink(f'/proc/{self.hosts[0]._first}/ns/uts')]
        os.kill(arm[0], signal.SIGKILL)
        self.assertRegex(launch.lines.wait_for('arm is lost with '), r"arm is lost with plain0-1: '/usr/bin/python3 .*' ended with exit code 137$")
        launch.lines.wait_for('[instead-3] ready')
        launch.send_signal(signal.SIGINT)
        self.assertEqual(launch.wait(PATIENCE), 3)
        with self.assertRaisesRegex(AssertionError, 'never: base is lost'):
            launch.lines.wait_for('base is lost')
        self.assert_nothing_left('what was started instead')

    def test_a_connection_that_freezes_is_lost(self):
        launch = self.start_trees([('plain', 'arm'), ('plain', 'base')])
        connections = self.parts(launch)['connection']
        self.assertEqual(len(connections), 2)
        for pid in connections:
            os.kill(pid, signal.SIGSTOP)
        began = time.monotonic()
        launch.lines.wait_for("the connection to machine 'arm' is lost: nothing has come for 1.5 s")
        launch.lines.wait_for("the connection to machine 'base' is lost: nothing has come for 1.5 s")
        self.assertLess(time.monotonic() - began, 20)
        self.assertEqual(launch.wait(PATIENCE), 3)
        self.assert_nothing_left('frozen')

    def test_an_agent_that_is_stopped_goes_on(self):
        launch = self.start_trees([('plain', 'arm'), ('plain', 'base')])
        agents = self.parts(launch)['agent']
        for pid in agents:
            os.kill(pid, signal.SIGSTOP)
        end = time.monotonic() + PATIENCE
        while any(Path(f'/proc/{pid}/stat').read_text().rpartition(')')[2].split()[0] == 'T' for pid in agents):
            self.assertLess(time.monotonic(), end)
            time.sleep(0.01)  # nothing tells that a process of another machine goes on
        launch.send_signal(signal.SIGINT)
        self.assertEqual(launch.wait(PATIENCE), 0)
        self.assert_nothing_left('stopped agents')

    def test_a_launcher_that_is_frozen_is_lost_for_the_agents(self):
        launch = self.start_trees([('plain', 'arm'), ('deaf', 'base')])
        launcher = self.parts(launch)['launcher'][0]
        before = self.marked()
        os.kill(launcher, signal.SIGSTOP)
        self.assert_nothing_left(f'frozen launcher {before}')
        os.kill(launcher, signal.SIGCONT)
        launch.wait(PATIENCE)

    def test_respawn_does_not_try_a_lost_machine_again(self):
        launch = self.start_trees([('plain', 'base')], f'<executable name="again" machine="arm" output="screen" respawn="true" '
                                  f'cmd="sh -c \'echo again; exec sleep 1000\'"/>')
        launch.lines.wait_for('[arm:again-2] again')
        self.kill(self.parts(launch), 'agent')
        launch.lines.wait_for("[arm:again-2]: exception occurred while executing process: the connection to machine 'arm' is lost")
        self.assertEqual(launch.wait(PATIENCE), 3)


if __name__ == '__main__':
    unittest.main()
