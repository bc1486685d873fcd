# SPDX-License-Identifier: Apache-2.0
"""Two machines of a test, a talker on one and a listener on the other, and a trace of both."""

import json
import os
import re
import signal
import time
from pathlib import Path

from machine_hosts import MARK, PATIENCE, Host, MachinesTest


# A connection that does something when the first file of a recording comes through it.
CABLE = '''
import os, subprocess, sys
agent = subprocess.Popen(sys.argv[2:], stdout=subprocess.PIPE)
while chunk := agent.stdout.read1(65536):
    begin, file, _ = chunk.partition(b'ust/uid')
    sys.stdout.buffer.write(begin + file)
    sys.stdout.buffer.flush()
    if file:
        if sys.argv[1] == 'cut':
            os._exit(1)
        agent.wait()  # nothing comes any more
'''


class TracedMachines(MachinesTest):
    def setUp(self):
        super().setUp()
        self.hosts = [self.host('arm'), self.host('base')]
        self.traces = self.folder / 'traces'
        self.name = f'walk{self.mark[:12]}'  # others use the session daemon of this machine, too
        self.environment['ROS_TRACE_DIR'] = str(self.traces)

    def start_nodes(self, trace, more='', keepalive=5, cable='', connect=Host.connect, machine=''):
        """A talker on one machine and a listener on the other; the talker has said something when this returns."""
        text = ''.join(f'<machine name="{host.name}" connect="{cable} {connect(host)}" keepalive="{keepalive}" {machine}/>\n'
                       for host in self.hosts)
        launch = self.start(self.file(
            f'{text}<set_env name="{MARK}" value="{self.mark}"/>\n{trace}\n'
            '<node pkg="demo_nodes_cpp" exec="talker" machine="arm" output="screen"/>\n'
            f'<node pkg="demo_nodes_cpp" exec="listener" machine="base" output="screen"/>\n{more}'))
        launch.lines.wait_for("[arm:talker-1] [INFO]")
        return launch

    def interrupt(self, launch):
        launch.send_signal(signal.SIGINT)
        code = launch.wait(PATIENCE)
        launch.lines._thread.join(PATIENCE)
        while (line := launch.lines._queue.get()) is not None:
            launch.lines.seen.append(line)
        return code

    def verdict(self, *folders):
        return json.loads(self.traces.joinpath(self.name, *folders, 'verdict.json').read_text())

    def recordings_there(self, host):
        return sorted(path.name for path in (host.folder / '.ros/tracing').glob('*'))

    def wait_for_file(self, path):
        end = time.monotonic() + PATIENCE
        while not path.exists():
            self.assertLess(time.monotonic(), end, f'there is no {path}')
            time.sleep(0.05)  # nobody tells of what guardians do when the launch is gone

    @staticmethod
    def left_in(host):
        return sorted(str(path.relative_to(host.folder)) for path in (host.folder / '.ros').rglob('*') if path.is_file())

    def assert_no_session(self, host):
        end = time.monotonic() + PATIENCE
        gone = ('no available recording session', 'No session daemon')
        while not any(words in (listed := host.run('lttng', 'list')) for words in gone):
            if time.monotonic() > end:
                self.fail(f'a session is left on {host.name}: {listed}')
            time.sleep(0.05)  # nothing tells of the end of a session of another machine

    def cable(self, does):
        path = self.folder / 'cable.py'
        path.write_text(CABLE)
        return f'/usr/bin/python3 {path} {does}'

    def agents(self, host):
        return [int(entry.name) for entry in Path('/proc').iterdir() if entry.name.isdigit() and self.is_agent(entry, host)]

    @staticmethod
    def is_agent(entry, host):
        try:
            return (os.readlink(entry / 'exe').endswith('/launch-agent')
                    and os.readlink(entry / 'ns/uts') == os.readlink(f'/proc/{host._first}/ns/uts'))
        except OSError:
            return False

    def kill_agent(self, host):
        for pid in self.agents(host):
            os.kill(pid, signal.SIGKILL)

    def kill_launcher_at(self, launch, number, line):
        """When the launch has said the line after the signal. Its guardian lives."""
        launchers = self.descendants(launch.pid)
        launch.send_signal(number)
        launch.lines.wait_for(line)
        for pid in launchers:
            os.kill(pid, signal.SIGKILL)
        launch.wait(PATIENCE)
        self.assert_nothing_left('killed launcher')

    @staticmethod
    def descendants(pid):
        """The processes below it that are launch itself."""
        found = []
        for entry in Path('/proc').iterdir():
            try:
                if entry.name.isdigit() and os.readlink(entry / 'exe').endswith('/launch'):
                    above = int(entry.name)
                    while above > 1 and above != pid:
                        above = int((Path('/proc') / str(above) / 'stat').read_text().rpartition(')')[2].split()[1])
                    if above == pid and int(entry.name) != pid:
                        found.append(int(entry.name))
            except OSError:
                continue
        return found
