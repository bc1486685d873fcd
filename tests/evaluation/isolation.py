# SPDX-License-Identifier: Apache-2.0
"""
A place of the evaluation's own on the machine.

As root the program runs again in namespaces of its own: /run with a session daemon of its own, /dev/shm and a loopback
network for DDS, so that nothing else on the machine is seen or traced. Otherwise LTTNG_HOME and the domain differ.
"""

import fcntl
import os
import select
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path

INSIDE = 'EVALUATION_INSIDE'
PATIENCE = 60.0  # seconds
RELAY_PORTS = (5342, 5343, 5344)  # control, data, live

_SIOCGIFFLAGS, _SIOCSIFFLAGS, _SIOCADDRT = 0x8913, 0x8914, 0x890B
_IFF_UP, _IFF_RUNNING, _IFF_MULTICAST = 0x1, 0x40, 0x1000


def enter():
    """As root, starts this program again in namespaces, once."""
    if os.geteuid() != 0 or os.environ.get(INSIDE) or shutil.which('unshare') is None:
        return
    os.environ[INSIDE] = '1'
    os.execvp('unshare', ['unshare', '--mount', '--net', '--propagation', 'private', sys.executable, '-B', '-m',
                          'evaluation', *sys.argv[1:]])


def _loopback_up():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as control:
        request = bytearray(struct.pack('16sH22x', b'lo', 0))
        fcntl.ioctl(control, _SIOCGIFFLAGS, request)
        flags = struct.unpack('16xH22x', request)[0] | _IFF_UP | _IFF_RUNNING | _IFF_MULTICAST
        fcntl.ioctl(control, _SIOCSIFFLAGS, struct.pack('16sH22x', b'lo', flags))
    # Multicast, with which DDS participants find each other.
    subprocess.run(('ip', 'route', 'add', '224.0.0.0/4', 'dev', 'lo'), check=True)


def _accepts(port):
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM) as probe:
        return probe.connect_ex(('127.0.0.1', port)) == 0


class Place:
    """The directory, the session daemon and the DDS domain of an evaluation."""

    def __init__(self):
        self.directory = Path(tempfile.mkdtemp(prefix='evaluate-'))
        self.isolated = bool(os.environ.get(INSIDE))
        self._relay = None
        if self.isolated:
            for folder in ('/run', '/dev/shm'):
                subprocess.run(('mount', '-t', 'tmpfs', '-o', 'mode=1777', 'tmpfs', folder), check=True)
            _loopback_up()
        self.domain = 1 if self.isolated else 2 + os.getpid() % 99
        os.environ.update(LTTNG_HOME=str(self.directory), ROS_HOME=str(self.directory / 'ros'),
                          ROS_LOG_DIR=str(self.directory / 'log'), XDG_CACHE_HOME=str(self.directory / 'cache'),
                          ROS_DOMAIN_ID=str(self.domain), TMPDIR=str(self.directory))
        subprocess.run(('lttng-sessiond', '--daemonize', f"--pidfile={self.directory / 'sessiond.pid'}"), check=True,
                       stdout=subprocess.DEVNULL)

    def start_relay(self):
        """Starts a relay daemon for sessions that write to the network, once. It ends with the place."""
        if self._relay is None:
            self._relay = subprocess.Popen(('lttng-relayd', f"--output={self.directory / 'relay'}"),
                                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            until = time.monotonic() + PATIENCE
            while not all(_accepts(port) for port in RELAY_PORTS):
                if self._relay.poll() is not None or time.monotonic() > until:
                    raise OSError('the relay daemon (lttng-relayd) does not start')
                time.sleep(0.01)

    def relay_seconds(self):
        """The processor time that the relay daemon has used."""
        fields = Path(f'/proc/{self._relay.pid}/stat').read_text().rpartition(')')[2].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf('SC_CLK_TCK')

    def close(self):
        if self._relay is not None:
            self._relay.terminate()
            self._relay.wait()
        try:
            pid = int((self.directory / 'sessiond.pid').read_text())
            ended = os.pidfd_open(pid)
            os.kill(pid, signal.SIGTERM)
            select.select([ended], [], [], 10)
            os.close(ended)
        except (OSError, ValueError):
            pass
        shutil.rmtree(self.directory, ignore_errors=True)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()
