# SPDX-License-Identifier: Apache-2.0
"""
Launches with a directory for sockets of their own. Other tests may have launches in the directory of the user, which is
looked into as well, so a test chooses by number.
"""

import json
import os
import queue
import subprocess
import tempfile
import threading
import unittest
from pathlib import Path

LAUNCH = os.environ['LAUNCH_PROGRAM']
PATIENCE = 120  # seconds

TALKER = '''<executable name="talker" shell="true" output="both"
    cmd="got() { echo got USR1; }; trap got USR1; echo ready; while :; do read x; done"/>'''
SLEEPER = '<executable name="sleeper" cmd="sleep 1000"/>'


class Lines:
    """Collects the lines of a pipe in a thread, and waits for one of them."""

    def __init__(self, pipe):
        self._queue = queue.Queue()
        self.seen = []
        self._thread = threading.Thread(target=self._read, args=(pipe,), daemon=True)
        self._thread.start()

    def _read(self, pipe):
        for line in pipe:
            self._queue.put(line.rstrip('\n'))
        self._queue.put(None)
        pipe.close()

    def wait_for(self, text, times=1):
        """The first line with this text, or so many of them: the last of these. Also those count that have come before."""
        while len(found := [line for line in self.seen if text in line]) < times:
            line = self._queue.get(timeout=PATIENCE)
            if line is None:
                raise AssertionError(f'never: {text}; lines: {self.seen}')
            self.seen.append(line)
        return found[times - 1]


class OwnLaunches(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix='own-')
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / 'run').mkdir(mode=0o700)
        self.environment = {name: value for name, value in os.environ.items() if not name.startswith(('ROS_', 'LAUNCH_ON'))}
        self.environment.update(XDG_RUNTIME_DIR=str(self.folder / 'run'), HOME=str(self.folder), ROS_HOME=str(self.folder))

    def start(self, *words):
        """A process that is killed at the end of the test; its `lines` are those of its standard output."""
        process = subprocess.Popen(words, cwd=self.folder, env=self.environment, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        process.lines = Lines(process.stdout)
        self.addCleanup(self.end, process)
        return process

    def end(self, process):
        if process.poll() is None:
            process.terminate()
        return process.wait(PATIENCE)

    def start_launch(self, actions=TALKER + SLEEPER, name='system.launch.xml'):
        """A launch whose process `talker` has printed its first line."""
        (self.folder / name).write_text(f'<launch>\n{actions}\n</launch>\n')
        launch = self.start(LAUNCH, name)
        launch.lines.wait_for('[talker-1] ready')
        return launch

    def launch(self, *words, **options):
        return subprocess.run([LAUNCH, *map(str, words)], cwd=self.folder, capture_output=True, text=True, check=False,
                              **{'timeout': PATIENCE, 'env': self.environment, 'stdin': subprocess.DEVNULL, **options})

    def processes(self, launch):
        """What `launch ps` says, by the names of the processes."""
        answer = json.loads(self.launch('ps', '--launch', launch.pid, '--json').stdout)
        return {process['name']: process for process in answer['launches'][0]['processes']}

    def pid_of(self, launch, name):
        return self.processes(launch)[name].get('pid')
