# SPDX-License-Identifier: Apache-2.0
"""The agent's side of a connection that is cut and made again; the launcher is this test, which speaks the protocol itself."""

import os
import re
import select
import shlex
import signal
import struct
import subprocess
import time
import unittest
from pathlib import Path

from machine_hosts import LAUNCH, MARK, PATIENCE, MachinesTest

SETUP, START, SIGNAL, CREDIT, RELEASE, PING, END, RESUME, ACKNOWLEDGE = 1, 2, 3, 4, 5, 8, 10, 32, 33
HELLO, STARTED, OUTPUT, CLOSED, EXITED, PONG, REFUSED, RESUMED, GONE = 1, 2, 4, 5, 6, 9, 10, 32, 34
WINDOW = 256 * 1024
ID, KEY = 'a1' * 16, 'b2' * 16


def text(value):
    data = value.encode()
    return struct.pack('>I', len(data)) + data


class Connection:
    """One connecting command, and what comes from the agent behind it."""

    def __init__(self, command, environment):
        self.process = subprocess.Popen(shlex.split(command) + [LAUNCH, 'agent'], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=subprocess.DEVNULL, env=environment, start_new_session=True, bufsize=0)
        self._bytes = b''
        self.greeting = self._line()

    def _more(self):
        if not select.select([self.process.stdout], [], [], PATIENCE)[0]:
            raise AssertionError('nothing comes from the agent')
        if not (data := os.read(self.process.stdout.fileno(), 65536)):
            raise EOFError
        self._bytes += data

    def _line(self):
        while b'\n' not in self._bytes:
            self._more()
        line, _, self._bytes = self._bytes.partition(b'\n')
        return line.decode()

    def send(self, kind, content=b''):
        self.process.stdin.write(struct.pack('>BI', kind, len(content)) + content)

    def take(self):
        """The next frame: kind and content."""
        while len(self._bytes) < 5 or len(self._bytes) < 5 + struct.unpack('>I', self._bytes[1:5])[0]:
            self._more()
        size = struct.unpack('>I', self._bytes[1:5])[0]
        kind, content = self._bytes[0], self._bytes[5:5 + size]
        self._bytes = self._bytes[5 + size:]
        return kind, content

    def cut(self):
        self.process.kill()
        self.close()

    def close(self):
        self.process.stdin.close()
        self.process.wait(PATIENCE)
        self.process.stdout.close()


class Launcher:
    """Of one agent, over several connections: counts what comes, as a launcher does, and gives credit for it."""

    def __init__(self, test, wait=300_000):
        self.test = test
        self.command = test.arm.connect()
        self.received = 0
        self.output = {}
        self.exits = {}
        self.closed = set()
        self.connection = self.connect()
        self.connection.send(SETUP, text('') + struct.pack('>I', 0) + text('arm') + struct.pack('>I', wait) + text(ID) + text(KEY))
        self.take_until(HELLO)

    def connect(self):
        connection = Connection(self.command, self.test.environment)
        self.test.addCleanup(connection.cut)
        return connection

    def start(self, run, script):
        words = ['/bin/sh', '-c', script]
        no = struct.pack('>Bq', 0, 0)
        limits = no + no + struct.pack('>iI', 0, 0) + no + no + struct.pack('>qqq', 0, 0, 0) + no + no + no
        environment = {'PATH': '/usr/bin:/bin', MARK: self.test.mark}
        content = struct.pack('>I', run) + text('sh') + text(f'sh-{run}') + struct.pack('>I', len(words)) + b''.join(map(text, words))
        content += struct.pack('>I', len(environment)) + b''.join(text(name) + text(value) for name, value in environment.items())
        content += text('/') + bytes([0, 0]) + bytes([1, 1, 0]) * 2 + limits + struct.pack('>qqI', 500_000_000, 500_000_000, 0)
        self.connection.send(START, content + bytes([0]) + struct.pack('>I', 0))

    def take(self):
        kind, content = self.connection.take()
        if kind < 32 and kind not in (PONG, REFUSED):
            self.received += 1
        if kind == OUTPUT:
            run, stream = struct.unpack('>IB', content[:5])
            self.output[run] = self.output.get(run, b'') + content[5:]
            self.connection.send(CREDIT, struct.pack('>IBI', run, stream, len(content) - 5))
        elif kind == EXITED:
            self.exits[struct.unpack('>I', content[:4])[0]] = struct.unpack('>i', content[4:8])[0]
        elif kind == CLOSED:
            self.closed.add(struct.unpack('>IB', content))
        return kind, content

    def take_until(self, wanted):
        while (frame := self.take())[0] != wanted:
            self.test.assertNotIn(frame[0], (REFUSED, GONE), frame)
        return frame[1]

    def wait_for_output(self, run, words):
        while words not in self.output.get(run, b''):
            self.take()

    def come_back(self, key=KEY, received=None):
        """Gets what the agent says to it."""
        self.connection = self.connect()
        self.connection.send(RESUME, text(ID) + text(key) + struct.pack('>Q', self.received if received is None else received))
        return self.connection.take()

    def end(self):
        self.connection.send(END)
        with self.test.assertRaises((EOFError, BrokenPipeError)):
            while True:
                self.connection.take()
        self.connection.process.wait(PATIENCE)


class AgentReturn(MachinesTest):
    def setUp(self):
        super().setUp()
        self.arm = self.host('arm')

    def door(self):
        door, = (self.arm.folder / 'tmp').glob('launch-*/agent-*')
        return door

    def agents(self):
        return [pid for pid in map(int, self.arm.run('pidof', 'launch-agent').split())]

    def wait_for_end_of_marked(self):
        self.assert_nothing_left('a process that ends by itself')

    def test_the_greeting_has_the_version_of_the_protocol(self):
        self.assertRegex(Launcher(self).connection.greeting, r'^launch-agent 2 \S+$')

    def test_output_of_the_meantime_comes_in_order_before_the_exit(self):
        launcher = Launcher(self)
        go = self.arm.folder / 'go'
        launcher.start(1, f'echo begin; while [ ! -e {go} ]; do sleep 0.02; done; seq 100000; echo end; exit 7')
        launcher.wait_for_output(1, b'begin\n')
        launcher.connection.cut()
        go.touch()
        self.wait_for_end_of_marked()
        kind, content = launcher.come_back()
        received, dropped = struct.unpack('>QI', content)
        self.assertEqual((kind, dropped), (RESUMED, 0))
        self.assertIn(received, (2, 3))  # the setup, the start, and the credit for the first line if the cut came after it
        launcher.take_until(EXITED)
        self.assertEqual(launcher.output[1].decode().split(), ['begin', *map(str, range(1, 100001)), 'end'])
        self.assertEqual((launcher.exits, launcher.closed), ({1: 7}, {(1, 0), (1, 1)}))
        launcher.connection.send(RELEASE, struct.pack('>I', 1))
        door = self.door()
        launcher.end()
        self.assertFalse(door.exists())

    def test_what_has_come_on_neither_side_is_sent_again_and_nothing_comes_twice(self):
        launcher = Launcher(self)
        launcher.start(1, 'i=0; while [ $i -lt 2000 ]; do echo $i; i=$((i + 1)); [ $((i % 50)) != 0 ] || sleep 0.05; done')
        for _ in range(12):
            while len(launcher.output.get(1, b'')) < 300 and 1 not in launcher.exits:
                launcher.take()
            counted = launcher.received
            launcher.connection.cut()
            self.assertEqual(launcher.come_back()[0], RESUMED)
            self.assertEqual(launcher.received, counted)
        while 1 not in launcher.exits:
            launcher.take()
        self.assertEqual(launcher.output[1].decode().split(), list(map(str, range(2000))))

    def test_lines_that_do_not_fit_are_counted(self):
        launcher = Launcher(self)
        go = self.arm.folder / 'go'
        launcher.start(1, f'echo begin; while [ ! -e {go} ]; do sleep 0.02; done; seq 300000')
        launcher.wait_for_output(1, b'begin\n')
        launcher.connection.cut()
        go.touch()
        self.wait_for_end_of_marked()
        kind, content = launcher.come_back()
        received, count, run, dropped = struct.unpack('>QIIQ', content)
        self.assertEqual((kind, count, run), (RESUMED, 1, 1))
        self.assertIn(received, (2, 3))  # as above
        launcher.take_until(EXITED)
        lines = launcher.output[1].decode().split()
        self.assertEqual(lines, ['begin', *map(str, range(1, len(lines)))])
        self.assertEqual(len(lines) - 1 + dropped, 300000)

    def test_a_wrong_key_and_a_wrong_number_change_nothing(self):
        launcher = Launcher(self)
        launcher.start(1, 'echo begin; while :; do sleep 0.05; echo on; done')
        launcher.wait_for_output(1, b'begin\n')
        before = launcher.connection
        self.assertEqual(launcher.come_back(key='0' * 32), (GONE, text('the agent there does not know this launch')))
        self.assertEqual(launcher.come_back(received=10 ** 6)[0], GONE)
        launcher.connection = before
        length = len(launcher.output[1])
        while len(launcher.output[1]) < length + 20:
            launcher.take()
        launcher.end()
        self.assert_nothing_left('an agent that strangers have visited')

    def test_a_new_connection_counts_although_the_old_one_is_not_cut(self):
        launcher = Launcher(self)
        launcher.start(1, 'echo begin; while :; do sleep 0.05; echo on; done')
        launcher.wait_for_output(1, b'begin\n')
        old = launcher.connection
        self.assertEqual(launcher.come_back()[0], RESUMED)
        length = len(launcher.output[1])
        while len(launcher.output[1]) < length + 20:
            launcher.take()
        launcher.end()
        self.assert_nothing_left('an agent with two connections')

    def test_without_a_return_all_ends_after_its_time(self):
        launcher = Launcher(self, wait=1500)
        launcher.start(1, 'echo begin; exec sleep 1000')
        launcher.wait_for_output(1, b'begin\n')
        door = self.door()
        began = time.monotonic()
        launcher.connection.cut()
        self.assert_nothing_left('an agent that has waited')
        self.assertGreater(time.monotonic() - began, 1.4)
        log, = (self.arm.folder / '.ros/log').glob('launch-agent-arm-*.log')
        self.assertRegex(log.read_text(), r'(?s)goes on for 1\.5 s, or until the launch comes back\n.*'
                                          r'nobody has come back for 1\.5 s: ending what runs here\n')
        while door.exists():  # the guardian removes it last
            self.assertLess(time.monotonic() - began, PATIENCE)
            time.sleep(0.02)
        self.assertEqual(launcher.come_back(), (GONE, text('the agent there has ended')))

    def test_the_guardian_ends_what_an_agent_leaves_that_is_killed_meanwhile(self):
        launcher = Launcher(self)
        launcher.start(1, 'echo begin; exec sleep 1000')
        launcher.wait_for_output(1, b'begin\n')
        launcher.connection.cut()
        self.arm.run('pkill', '-KILL', '-x', 'launch-agent')  # of this machine alone
        self.assert_nothing_left('an agent that was killed')
        self.assertEqual(launcher.come_back(), (GONE, text('the agent there has ended')))


if __name__ == '__main__':
    unittest.main()
