# SPDX-License-Identifier: Apache-2.0
"""
Machines for tests of launches over several machines.

A host has namespaces of its own for processes, mounts, network and host name. It lives until the test ends, whoever
connects, as a real machine does: a connecting command has something run there by its door, and what that leaves there stays.
"""

import os
import shutil
import signal
import subprocess
import tempfile
import time
import unittest
import uuid
from pathlib import Path

from own_launches import LAUNCH, PATIENCE, Lines

MARK = 'TEST_OF_MACHINES'
DOOR = f"/usr/bin/python3 {Path(__file__).with_name('machine_door.py')}"


def namespaces(*words):
    user = () if os.geteuid() == 0 else ('--user', '--map-root-user')
    return ['unshare', *user, '--pid', '--mount', '--uts', '--net', '--ipc', '--fork', '--kill-child', '--mount-proc', *words]


class Host:
    def __init__(self, name, folder):
        self.name = name
        self.folder = folder / name
        self.folder.mkdir()
        (self.folder / 'tmp').mkdir()
        # The session daemon of LTTng of a machine, and what it shares with its processes, belong to this machine.
        # Its home directory may be below /tmp, and is the same there.
        home = self.folder.relative_to('/tmp') if self.folder.is_relative_to('/tmp') else 'home'
        script = (f'hostname {name}; mkdir -p {self.folder}/tmp/{home}; mount --bind {self.folder} {self.folder}/tmp/{home}; '
                  f'mount --rbind {self.folder}/tmp /tmp; mount -t tmpfs tmpfs /dev/shm; '
                  'mkdir -p /run/lttng 2>/dev/null; [ ! -d /run/lttng ] || mount -t tmpfs tmpfs /run/lttng; ip link set lo up; '
                  f'exec {DOOR} serve {self.folder}/door')
        self._keeper = subprocess.Popen(namespaces('sh', '-c', script), stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, text=True)
        if self._keeper.stdout.readline() != 'ready\n':
            self._keeper.kill()
            raise unittest.SkipTest(f'skipped, because namespaces can\'t be made here: {self._keeper.stderr.read().strip()}')
        children = Path(f'/proc/{self._keeper.pid}/task/{self._keeper.pid}/children').read_text().split()
        self._first = children[0]

    def connect(self, *environment):
        """The connecting command. What runs there has the environment of a login, with these variables added."""
        return f'{DOOR} enter {self.folder}/door ' + ' '.join(self._login(*environment))

    def enter(self):
        """A connecting command of another kind: what runs there is a child of the process that connects."""
        return ' '.join(self._words())

    def _login(self, *environment):
        return ['env', '-i', f'HOME={self.folder}', f'PATH={Path(LAUNCH).parent}:/usr/bin:/bin', *environment]

    def _words(self):
        user = () if os.geteuid() == 0 else ('-U', '--preserve-credentials')
        return ['nsenter', '-t', self._first, *user, '-p', '-m', '-u', '-n', '-i', '--', *self._login()]

    def run(self, *command):
        """What the command prints there."""
        return subprocess.run([*self._words(), *command], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              text=True, check=False, timeout=PATIENCE).stdout

    def link(self, other, network='192.168.77'):
        """Joins the networks of two hosts, by a cable between them."""
        subprocess.run(['ip', 'link', 'add', 'cable', 'netns', self._first, 'type', 'veth', 'peer', 'name', 'cable', 'netns', other._first],
                       check=True, timeout=PATIENCE)
        for host, number in ((self, 1), (other, 2)):
            host.run('sh', '-c', f'PATH=$PATH:/usr/sbin:/sbin; ip address add {network}.{number}/24 dev cable; ip link set cable up; '
                                 'ip route add 224.0.0.0/4 dev cable')

    def cut(self):
        """Kills what connects to it; nobody can connect until open_door()."""
        door = f'{self.folder}/door'
        os.rename(door, f'{door}.shut')
        for entry in Path('/proc').iterdir():
            try:
                words = (entry / 'cmdline').read_bytes().split(b'\0') if entry.name.isdigit() else ()
                if b'enter' in words and door.encode() in words:
                    os.kill(int(entry.name), signal.SIGKILL)
            except OSError:
                continue

    def open_door(self):
        os.rename(self.folder / 'door.shut', self.folder / 'door')

    def end(self):
        self._keeper.kill()
        self._keeper.wait(PATIENCE)
        self._keeper.stdout.close()
        self._keeper.stderr.close()


class MachinesTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix='machines-')
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / 'run').mkdir(mode=0o700)
        self.mark = uuid.uuid4().hex
        self.environment = {name: value for name, value in os.environ.items() if not name.startswith(('ROS_', 'LAUNCH_ON', 'AMENT_'))}
        self.environment.update(XDG_RUNTIME_DIR=str(self.folder / 'run'), HOME=str(self.folder), ROS_HOME=str(self.folder))
        self.addCleanup(self.end_marked)

    def host(self, name):
        for tool in ('unshare', 'nsenter'):
            if not shutil.which(tool):
                self.skipTest(f'skipped, because there is no {tool}: the package util-linux is not installed')
        host = Host(name, self.folder)
        self.addCleanup(host.end)
        return host

    def plain(self, *environment):
        """A connecting command that leads to this machine, with an environment of its own."""
        return f'env -i HOME={self.folder} PATH={Path(LAUNCH).parent}:/usr/bin:/bin ' + ' '.join(environment)

    def file(self, text, name='system.launch.xml'):
        path = self.folder / name
        path.write_text(f'<launch>\n{text}\n</launch>\n' if name.endswith('.xml') else text)
        return name

    def launch(self, *words, **options):
        """Runs to its end."""
        return subprocess.run([LAUNCH, *map(str, words)], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              check=False, timeout=PATIENCE, env=self.environment, stdin=subprocess.DEVNULL, **options)

    def start(self, *words):
        """Runs; its `lines` are those of its output."""
        process = subprocess.Popen([LAUNCH, *map(str, words)], cwd=self.folder, env=self.environment, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, process_group=0)
        process.lines = Lines(process.stdout)
        self.addCleanup(self.end, process)
        return process

    def end(self, process):
        if process.poll() is None:
            process.terminate()
        return process.wait(PATIENCE)

    def marked(self):
        """The processes, of any machine, that have the mark of this test in their environment; by number, with their command."""
        wanted = f'{MARK}={self.mark}'.encode()
        found = {}
        for entry in Path('/proc').iterdir():
            if entry.name.isdigit():
                try:
                    if wanted in (entry / 'environ').read_bytes().split(b'\0'):
                        found[int(entry.name)] = (entry / 'cmdline').read_bytes().replace(b'\0', b' ').decode(errors='replace')
                except OSError:
                    continue
        return found

    def assert_nothing_left(self, what):
        end = time.monotonic() + PATIENCE
        while left := self.marked():
            if time.monotonic() > end:
                self.fail(f'{what}: left behind: {left}')
            time.sleep(0.05)  # nothing tells of the end of a process of another machine

    def end_marked(self):
        for pid in self.marked():
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                continue
