# SPDX-License-Identifier: Apache-2.0
"""
A place of a campaign's own on the machine: session daemon, traces, and what reads them.

As root the program runs again in namespaces of its own: processes, network, /run and /dev/shm. What is left when it ends
is ended with the namespace. Otherwise LTTNG_HOME keeps it apart from other sessions of the user.
"""

import json
import os
import re
import select
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path
from xml.sax.saxutils import quoteattr

INSIDE = 'CAMPAIGN_INSIDE'
PATIENCE = 120.0  # seconds after which a launch does not end
MOST_THREADS, MOST_PROCESSORS = 16, 64  # of firing_app
EVENT = re.compile(r'^\[(\d+)\].* campaign:(?:even|odd): \{ cpu_id = (\d+) \}.*'
                   r'\{ thread = (\d+), number = (\d+),')
PROCESS = re.compile(r' vpid = (\d+)')
STARTED = re.compile(r'\[app_(\d+)-\d+\]: process started with pid \[(\d+)\]')


def enter():
    """As root, starts this program again in namespaces, once."""
    if os.geteuid() != 0 or os.environ.get(INSIDE) or shutil.which('unshare') is None:
        return
    os.environ[INSIDE] = '1'
    script = ('mount -t tmpfs -o mode=1777 tmpfs /run && mount -t tmpfs -o mode=1777 tmpfs /dev/shm && ip link set lo up && '
              'ip route add 224.0.0.0/4 dev lo && "$@"; exit $?')  # the shell stays, and reaps daemons
    os.execvp('unshare', ['unshare', '--mount', '--net', '--pid', '--fork', '--kill-child', '--mount-proc', '--propagation',
                          'private', 'bash', '-c', script, 'campaigns', sys.executable, '-B', '-m', 'campaigns',
                          *sys.argv[1:]])


@dataclass
class Launch:
    """A launch that has ended."""

    code: int       # None: it did not end in time
    output: str
    seconds: float


@dataclass
class Fired:
    """What one thread of firing_app has fired: its own record."""

    begun: int
    done: int
    last: dict  # by processor: number and time of the last event there


@dataclass
class Recorded:
    """What babeltrace2 reads."""

    readable: bool
    error: str
    events: list        # (time, cpu, thread, number, process) of firing_app's events; process 0 without its context
    others: int         # events of others
    discarded: int      # sum of its warnings, unless one has wrapped around
    lost_packets: int
    wrapped: bool


class Place:
    def __init__(self, build):
        self.build = Path(build)
        self.program = self.build / 'prefix/bin/launch'
        self.firing_app = self.build / 'tests/campaigns/firing_app'
        self.interrupted_app = self.build / 'tests/unit/session/interrupted_app'
        self.directory = Path(tempfile.mkdtemp(prefix='campaign-'))
        self.run = 0
        self._children = []
        os.environ.update(LTTNG_HOME=str(self.directory), HOME=str(self.directory), ROS_HOME=str(self.directory / 'ros'),
                          ROS_LOG_DIR=str(self.directory / 'log'), TMPDIR=str(self.directory),
                          XDG_RUNTIME_DIR=str(self.directory), LTTNG_UST_REGISTER_TIMEOUT='-1')

    # Directories and daemons.

    def new_run(self):
        """Makes the directory of another run, with a session daemon that has seen nothing yet; removes the last one."""
        self.end_daemons()
        shutil.rmtree(self.path(), ignore_errors=True)
        self.run += 1
        self.path().mkdir()
        subprocess.run(('lttng-sessiond', '--daemonize'), check=True, stdout=subprocess.DEVNULL)

    def path(self, *parts):
        return self.directory.joinpath(f'run-{self.run}', *parts)

    def daemons(self, name):
        """The ids of the daemons of this place that have this name."""
        found = []
        for process in Path('/proc').glob('[0-9]*'):
            try:
                words = (process / 'cmdline').read_bytes().split(b'\0')
                own = f'LTTNG_HOME={self.directory}'.encode() in (process / 'environ').read_bytes().split(b'\0')
            except OSError:
                continue
            if own and os.path.basename(words[0]).decode() == name:
                found.append(int(process.name))
        return found

    def end_daemons(self):
        for name in ('lttng-sessiond', 'lttng-consumerd', 'lttng-relayd'):
            for pid in self.daemons(name):
                try:
                    ended = os.pidfd_open(pid)
                    os.kill(pid, signal.SIGKILL)
                except OSError:
                    continue
                select.select([ended], [], [], 10)
                os.close(ended)
        for file in Path('/dev/shm').glob('ust-shm-*'):
            file.unlink(missing_ok=True)  # of killed daemons

    def start(self, *command, **options):
        """Starts a process that ends with the place."""
        child = subprocess.Popen([str(word) for word in command], **options)
        self._children.append(child)
        return child

    def make_busy(self, loops):
        for _ in range(loops):
            self.start(sys.executable, '-c', 'while True: pass')

    def close(self):
        for child in self._children:
            if child.poll() is None:
                child.kill()
                child.wait()
        self.end_daemons()
        shutil.rmtree(self.directory, ignore_errors=True)

    # Launches.

    def trace_tag(self, name='trace', items='', **attributes):
        """A <trace> of firing_app's events into the directory of this run; _ in names of attributes stands for -."""
        given = {'session_name': name, 'base_path': self.path(), 'events_ust': 'campaign:*', 'launch_events': 'false',
                 **attributes}
        words = ' '.join(f"{key.replace('_', '-')}={quoteattr(str(value))}" for key, value in given.items())
        return f'<trace {words}>{items}</trace>'

    def app_tag(self, number=0, attributes='', **arguments):
        """An <executable> of firing_app; its record is counts(number)."""
        words = ' '.join(f'{key}={value}' for key, value in arguments.items())
        command = f"{self.firing_app} {self.path(f'counts-{number}')} {words}"
        return f'<executable name="app_{number}" cmd={quoteattr(command)} {attributes}/>'

    def start_launch(self, *tags):
        file = self.path('system.launch.xml')
        file.write_text('<launch>\n' + '\n'.join(tags) + '\n</launch>\n', encoding='utf-8')
        self._log = open(self.path('launch.log'), 'w+', encoding='utf-8')
        self._begin = time.monotonic()
        return self.start(self.program, '--timing', file, stdin=subprocess.DEVNULL, stdout=self._log, stderr=subprocess.STDOUT)

    def end_launch(self, process, patience=PATIENCE):
        try:
            code = process.wait(patience)
        except subprocess.TimeoutExpired:
            code = None
            process.kill()
            process.wait()
        self._log.close()
        return Launch(code, self.path('launch.log').read_text(encoding='utf-8'), time.monotonic() - self._begin)

    def launch(self, *tags, patience=PATIENCE):
        return self.end_launch(self.start_launch(*tags), patience)

    def started(self):
        """The process ids of the firing_apps of this run that have started, by number."""
        log = self.path('launch.log').read_text(encoding='utf-8', errors='replace')
        return {int(number): int(pid) for number, pid in STARTED.findall(log)}

    def start_relay(self):
        """Starts a relay daemon that writes to the folder `relayed` of this run."""
        subprocess.run(('lttng-relayd', '--daemonize', f"--output={self.path('relayed')}"), check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    # What was fired, recorded and said.

    def counts(self, number=0):
        """The record of a firing_app: for each thread that has fired."""
        thread = struct.Struct(f'<QQ{2 * MOST_PROCESSORS}Q')
        try:
            data = self.path(f'counts-{number}').read_bytes()
        except FileNotFoundError:
            return {}
        fired = {}
        for index in range(min(MOST_THREADS, len(data) // thread.size)):
            begun, done, *last = thread.unpack_from(data, index * thread.size)
            if begun != 0:
                fired[index] = Fired(begun, done, {cpu: (last[2 * cpu], last[2 * cpu + 1])
                                                   for cpu in range(MOST_PROCESSORS) if last[2 * cpu] != 0})
        return fired

    @staticmethod
    def verdict(directory):
        try:
            return json.loads((Path(directory) / 'verdict.json').read_text(encoding='utf-8'))
        except (OSError, ValueError):
            return None

    @staticmethod
    def read(directory):
        """Reads a trace with babeltrace2, the whole of it."""
        done = subprocess.run(('babeltrace2', '--clock-cycles', '--no-delta', str(directory)), capture_output=True,
                              encoding='utf-8', errors='replace')
        events, others = [], 0
        for line in done.stdout.splitlines():
            match = EVENT.match(line)
            if match:
                process = PROCESS.search(line)
                events.append((*map(int, match.groups()), int(process[1]) if process else 0))
            else:
                others += 1
        discarded = [int(count) for count in re.findall(r'racer discarded (\d+) event', done.stderr)]
        lost = [int(count) for count in re.findall(r'racer discarded (\d+) packet', done.stderr)]
        errors = [line for line in done.stderr.splitlines() if 'ERROR' in line or line.startswith('CAUSED BY')]
        return Recorded(done.returncode == 0, errors[0] if errors else '', events, others,
                        sum(discarded), sum(lost), any(count > 2 ** 62 for count in discarded))


def lttng(*arguments):
    return subprocess.run(('lttng', *arguments), capture_output=True, text=True, timeout=60)
