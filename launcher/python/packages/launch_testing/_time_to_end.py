# SPDX-License-Identifier: Apache-2.0
"""
The time in which processes may end by themselves before a launch without active tests is ended.

It is time of their own: what a process has run, and when nothing of its group wanted to run. While it waits for a
processor no time passes, so a busy machine interrupts no process that has not come to its work yet.
"""

import os
import time

_OWN_TIME = 2.0  # seconds
LOOK = 0.05  # seconds between looks
_TICK = os.sysconf('SC_CLK_TCK')
_NO_PROCESS = -1  # a launch that has started none has the same time
_STATE, _GROUP, _USER, _SYSTEM = 0, 2, 11, 12  # fields behind the name in /proc/PID/stat


def _processes():
    for name in os.listdir('/proc'):
        if name.isdigit():
            try:
                with open(f'/proc/{name}/stat', encoding='utf-8', errors='replace') as file:
                    yield file.read().rpartition(')')[2].split()
            except OSError:
                pass  # it has just ended


def _groups():
    """{number of a process group: (seconds that its processes have run, whether one wants to run)}"""
    found = {}
    for fields in _processes():
        group = int(fields[_GROUP])
        seconds, wants = found.get(group, (0.0, False))
        found[group] = (seconds + (int(fields[_USER]) + int(fields[_SYSTEM])) / _TICK,
                        wants or fields[_STATE] in ('R', 'D'))
    return found


class TimeToEnd:
    """Of the processes with these numbers, each of which leads a group."""

    def __init__(self):
        self._idle = {}  # seconds in which nothing of a group wanted to run
        self._last_look = time.monotonic()

    def is_over(self, running):
        """Whether each of the running processes has had its time. Called again and again."""
        now = time.monotonic()
        # The one who looks waits for a processor, too: no process has had more than one look's time meanwhile.
        passed, self._last_look = min(now - self._last_look, 2 * LOOK), now
        groups = _groups()
        running = running or {_NO_PROCESS}
        for pid in running:
            if not groups.get(pid, (0.0, False))[1]:
                self._idle[pid] = self._idle.get(pid, 0.0) + passed
        return all(self._idle.get(pid, 0.0) + groups.get(pid, (0.0, False))[0] >= _OWN_TIME for pid in running)

    def wait(self, none_is_left, running):
        """Waits until the event `none_is_left` is set, or the processes that `running()` gives have had their time."""
        while not none_is_left.wait(LOOK):
            if self.is_over(running()):
                return
