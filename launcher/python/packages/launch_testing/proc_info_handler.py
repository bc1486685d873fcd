# SPDX-License-Identifier: Apache-2.0
"""The starts and the ends of processes."""

import threading

from launch.events.process import ProcessExited
from launch_testing.util import NoMatchingProcessException, resolveProcesses

__unittest = True  # tracebacks of tests end at the test


class ProcInfoHandler:
    """The last event of each process: ProcessStarted, or ProcessExited with its `returncode`."""

    def __init__(self):
        self._events = {}

    def append(self, event):
        self._events[event.action] = event

    def __iter__(self):
        return iter(list(self._events.values()))

    def processes(self):
        return self._events.keys()

    def process_names(self):
        return [process.process_details['name'] for process in self._events]

    def __getitem__(self, key):
        """The event of a process, which is an action or a part of a name."""
        if not isinstance(key, str):
            return self._events[key]
        for process, event in self._events.items():
            if key in process.process_details['name']:
                return event
        raise KeyError(key)


class ActiveProcInfoHandler(ProcInfoHandler):
    """The same while processes start and end, with methods that wait for it."""

    def __init__(self):
        self._condition = threading.Condition()
        self._proc_info_handler = ProcInfoHandler()

    @property
    def proc_event(self):
        """A condition that is notified of each event."""
        return self._condition

    def append(self, event):
        with self._condition:
            self._proc_info_handler.append(event)
            self._condition.notify_all()

    def __iter__(self):
        with self._condition:
            return iter(self._proc_info_handler)

    def processes(self):
        with self._condition:
            return list(self._proc_info_handler.processes())

    def process_names(self):
        with self._condition:
            return self._proc_info_handler.process_names()

    def __getitem__(self, key):
        with self._condition:
            return self._proc_info_handler[key]

    def _wait(self, process, cmd_args, timeout, accepts):
        def has_happened():
            try:
                found = resolveProcesses(self._proc_info_handler, process=process, cmd_args=cmd_args)[0]
            except NoMatchingProcessException:
                return False
            return accepts(self._proc_info_handler[found])

        with self._condition:
            return self._condition.wait_for(has_happened, timeout=timeout)

    def assertWaitForStartup(self, process, cmd_args=None, *, timeout=10):  # noqa: N802
        """The process has started, or has even ended again."""
        assert self._wait(process, cmd_args, timeout, lambda _event: True), (
            f"Timed out waiting for process '{process}' to start")

    def assertWaitForShutdown(self, process, cmd_args=None, *, timeout=10):  # noqa: N802
        """The process has ended."""
        assert self._wait(process, cmd_args, timeout, lambda event: isinstance(event, ProcessExited)), (
            f"Timed out waiting for process '{process}' to finish")
