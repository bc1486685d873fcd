# SPDX-License-Identifier: Apache-2.0
"""A connection that is cut, and what runs on the machine goes on: on_disconnect="keep". And the grace of "stop"."""

import os
import re
import signal
import time
import unittest
from pathlib import Path

from machine_hosts import MARK, PATIENCE, MachinesTest

# Writes a line each time that a line is written to its fifo, `end` is its end, and a number so many lines at once.
ECHO = '''rm -f F; mkfifo F; echo ready; exec 3&lt;&gt;F; while read word &lt;&amp;3; do case $word in end) exit 7;; [1-9]*) seq $word;; *) echo got $word;; esac; done'''


class MachineKeep(MachinesTest):
    def setUp(self):
        super().setUp()
        self.arm = self.host('arm')
        self.fifo = self.arm.folder / 'fifo'

    def start_echo(self, more='', machine='on_disconnect="keep"', attributes=''):
        launch = self.start(self.file(f'''
          <machine name="arm" connect="{self.arm.connect()}" keepalive="2" {machine}/>
          <set_env name="{MARK}" value="{self.mark}"/>
          <executable name="echo" machine="arm" output="screen" shell="false" {attributes}
            cmd="sh -c '{ECHO.replace('F', str(self.fifo))}'"/>
          {more}'''))
        launch.lines.wait_for('[arm:echo-1] ready')
        return launch

    def say(self, *words):
        with open(self.fifo, 'w') as fifo:
            for word in words:
                fifo.write(f'{word}\n')

    def agents(self):
        """The agents of the machine that have started something, not those that only lead to one."""
        host = os.readlink(f'/proc/{self.arm._first}/ns/uts')
        parents = set()
        agents = []
        for entry in Path('/proc').iterdir():
            try:
                if entry.name.isdigit() and os.readlink(entry / 'ns/uts') == host:
                    parents.add(int((entry / 'stat').read_text().rpartition(')')[2].split()[1]))
                    if os.readlink(entry / 'exe').endswith('/launch-agent'):
                        agents.append(int(entry.name))
            except OSError:
                continue
        return [pid for pid in agents if pid in parents]

    def cut(self, launch, times=1):
        """Nobody can connect until the door is opened."""
        self.arm.cut()
        launch.lines.wait_for("the connection to machine 'arm' is lost: ", times)

    def interrupt(self, launch):
        launch.send_signal(signal.SIGINT)
        code = launch.wait(PATIENCE)
        self.take_lines(launch)
        return code

    def take_lines(self, launch):
        """All that it has written."""
        launch.lines._thread.join(PATIENCE)
        while (line := launch.lines._queue.get()) is not None:
            launch.lines.seen.append(line)

    def wait_until_ended(self, command):
        end = time.monotonic() + PATIENCE
        while any(command in words for words in self.marked().values()):
            self.assertLess(time.monotonic(), end)
            time.sleep(0.02)  # nothing tells of the end of a process of another machine

    def printed(self, launch, label='[arm:echo-1] '):
        return [line.partition(label)[2] for line in launch.lines.seen if line.startswith(label)]

    def test_output_and_the_exit_of_the_meantime_come_complete_and_in_order(self):
        launch = self.start_echo('''
          <on_machine_lost><log message="lost $(var event.machine) with $(var event.processes)"/></on_machine_lost>
          <on_machine_back machine="arm">
            <log message="back: $(var event.machine), $(var event.for), $(var event.dropped)"/>
          </on_machine_back>
          <executable name="stays" cmd="sleep 1000"/>''')
        self.say('before')
        launch.lines.wait_for('got before')
        self.cut(launch)
        self.assertIn('; what runs there goes on for 300 s: echo-1; launch connects again',
                      launch.lines.wait_for("the connection to machine 'arm' is lost: "))
        launch.lines.wait_for('lost arm with echo-1')
        self.say('meanwhile', '3000', 'last', 'end')
        self.wait_until_ended(str(self.fifo))
        self.arm.open_door()
        launch.lines.wait_for("machine 'arm' is back after ")
        self.assertRegex(launch.lines.wait_for('back: arm, '), r'back: arm, \d+\.\d, 0$')
        launch.lines.wait_for('process has died [pid ')
        self.assertIn('exit code 7', launch.lines.wait_for('process has died [pid '))
        self.assertEqual(self.printed(launch)[:3003],
                         ['ready', 'got before', 'got meanwhile', *map(str, range(1, 3001))])
        self.assertIn('got last', self.printed(launch))
        self.assertIsNone(launch.poll())
        self.interrupt(launch)
        self.assert_nothing_left('a machine that was away')

    def test_a_connection_may_be_cut_again_and_again(self):
        launch = self.start_echo()
        for number in range(1, 4):
            self.cut(launch, number)
            self.say(f'away{number}')
            self.arm.open_door()
            launch.lines.wait_for("machine 'arm' is back after ", number)
            self.say(f'there{number}')
            launch.lines.wait_for(f'got there{number}')
        self.assertEqual(self.printed(launch), ['ready', 'got away1', 'got there1', 'got away2', 'got there2', 'got away3', 'got there3'])
        self.assertEqual(self.interrupt(launch), 0)
        self.assert_nothing_left('a machine that was away three times')

    def test_what_does_not_fit_into_the_spool_is_counted(self):
        launch = self.start_echo()
        self.cut(launch)
        self.say('300000', 'last')  # 2 MB
        self.say('end')
        self.wait_until_ended(str(self.fifo))
        self.arm.open_door()
        told = launch.lines.wait_for("while machine 'arm' was away, lines of output were dropped: ")
        dropped = int(re.search(r'dropped: (\d+) of echo-1$', told)[1])
        launch.wait(PATIENCE)
        self.take_lines(launch)
        printed = self.printed(launch)
        self.assertEqual(printed, ['ready', *map(str, range(1, len(printed)))])
        self.assertEqual(len(printed) - 1 + dropped, 300001)
        self.assertGreater(dropped, 1000)

    def test_requests_for_a_machine_that_is_away_say_so(self):
        launch = self.start_echo()
        self.cut(launch)
        for command in 'stop', 'restart':
            refused = self.launch(command, 'echo', '--launch', launch.pid)
            self.assertEqual((refused.returncode, "echo-1 runs on machine 'arm', which is away" in refused.stdout), (1, True), refused.stdout)
        self.assertIn('running on arm, which is away ', self.launch('ps', '--launch', launch.pid).stdout)
        self.arm.open_door()
        launch.lines.wait_for("machine 'arm' is back after ")
        self.assertNotIn('away', self.launch('ps', '--launch', launch.pid).stdout)
        self.assertEqual(self.launch('restart', 'echo', '--launch', launch.pid).returncode, 0)
        launch.lines.wait_for('[arm:echo-1] ready', 2)
        self.assertEqual(self.interrupt(launch), 0)
        self.assert_nothing_left('a process that was restarted after the return')

    def test_a_launcher_that_never_comes_back_is_waited_for_so_long_only(self):
        launch = self.start_echo(machine='on_disconnect="keep" keep_for="3"')
        began = time.monotonic()
        for pid in self.launchers(launch):
            os.kill(pid, signal.SIGKILL)
        self.assertTrue(any(str(self.fifo) in words for words in self.marked().values()))
        self.assert_nothing_left('a launcher that was killed')
        self.assertGreater(time.monotonic() - began, 2)
        launch.wait(PATIENCE)
        log, = (self.arm.folder / '.ros/log').glob('launch-agent-arm-*.log')
        self.assertRegex(log.read_text(), r'what runs here goes on for 3 s, or until the launch comes back\n'
                                          r'(.*\n)*.*nobody has come back for 3 s: ending what runs here\n')

    def launchers(self, launch):
        """The guardian, the spare and the launcher."""
        found = [launch.pid]
        for pid in found:
            found += [int(child) for child in Path(f'/proc/{pid}/task/{pid}/children').read_text().split()
                      if os.readlink(f'/proc/{child}/exe').rpartition('/')[2] in ('launch', 'launch-guardian')]
        return found

    def test_an_agent_that_dies_meanwhile_is_found_out(self):
        launch = self.start_echo()
        self.cut(launch)
        agent, = self.agents()
        os.kill(agent, signal.SIGKILL)
        self.assert_nothing_left('an agent that was killed')
        self.arm.open_door()
        self.assertIn("machine 'arm' does not come back: the agent there has ended; what ran there: echo-1; the guardian there ends it",
                      launch.lines.wait_for('does not come back'))
        launch.lines.wait_for("[arm:echo-1]: process is lost with machine 'arm'")
        self.assertEqual(launch.wait(PATIENCE), 3)

    def test_an_end_tries_to_reach_a_machine_that_is_away(self):
        launch = self.start_echo()
        self.cut(launch)
        launch.send_signal(signal.SIGINT)
        launch.lines.wait_for("machine 'arm' is away; launch tries to reach it for 5 s before it ends")
        self.arm.open_door()
        self.assertEqual(launch.wait(PATIENCE), 0)
        self.assert_nothing_left('an end that has reached the machine')

    def test_an_end_says_what_stays_on_a_machine_that_is_away(self):
        launch = self.start_echo(machine='on_disconnect="keep" keep_for="8"')
        self.cut(launch)
        self.assertEqual(self.interrupt(launch), 3)
        line = launch.lines.wait_for("machine 'arm' does not come back: there was no connection for ")
        self.assertIn('; what ran there: echo-1; the agent there ends it 8 s after the loss', line)
        self.assert_nothing_left('an end that has not reached the machine')

    def test_grace_lets_processes_go_on_for_so_long(self):
        launch = self.start_echo(machine='grace="2"')
        began = time.monotonic()
        self.cut(launch)
        launch.lines.wait_for("; what ran there: echo-1; the agent there ends it after 2 s")
        self.assertEqual(launch.wait(PATIENCE), 3)
        self.assert_nothing_left('grace')
        self.assertGreater(time.monotonic() - began, 2)

    def test_only_the_launch_itself_can_come_back(self):
        launch = self.start_echo()
        door, = (self.arm.folder / 'tmp').glob('launch-*/agent-*')
        self.assertEqual((door.stat().st_mode & 0o777, door.parent.stat().st_mode & 0o777), (0o600, 0o700))
        answer = self.arm.run('python3', '-c', f'''
import glob, socket, struct
door = socket.socket(socket.AF_UNIX)
door.connect(glob.glob("/tmp/launch-*/agent-*")[0])
text = lambda value: struct.pack(">I", len(value)) + value
content = text(b"{door.name.partition('-')[2]}") + text(b"0" * 32) + struct.pack(">Q", 0)
door.sendall(bytes([32]) + text(content))
print(door.recv(100))''')
        self.assertEqual(answer, "b''\n")
        self.say('still')
        launch.lines.wait_for('got still')
        self.assertEqual(self.interrupt(launch), 0)
        self.assertFalse(door.exists())


if __name__ == '__main__':
    unittest.main()
