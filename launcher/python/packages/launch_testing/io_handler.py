# SPDX-License-Identifier: Apache-2.0
"""What processes have written."""

import threading

from launch_testing.asserts import assertInStream
from launch_testing.util import NoMatchingProcessException, resolveProcesses

__unittest = True  # tracebacks of tests end at the test


class IoHandler:
    """The lines of all processes, in their order: events with `text` (bytes), `from_stdout` and `from_stderr`."""

    def __init__(self):
        self._lines = []
        self._by_process = {}
        self._names = set()  # of processes whose action is not known

    def track(self, process):
        """A process that has started belongs to it even before it writes something: an action, or a name."""
        if isinstance(process, str):
            self._names.add(process)
        else:
            self._by_process.setdefault(process, [])

    def append(self, event):
        self._lines.append(event)
        self._by_process.setdefault(event.action, []).append(event)

    def __iter__(self):
        return iter(list(self._lines))

    def processes(self):
        return list(self._by_process)

    def process_names(self):
        names = [process.process_details['name'] for process in self._by_process]
        return names + sorted(self._names.difference(names))

    def __getitem__(self, key):
        """The lines of a process, which is an action or the name of a process."""
        if not isinstance(key, str):
            return list(self._by_process[key])
        for process, lines in self._by_process.items():
            if process.process_details['name'] == key:
                return list(lines)
        if key in self._names:
            return []
        raise KeyError(key)


class ActiveIoHandler(IoHandler):
    """The same while processes write, with methods that wait for output."""

    def __init__(self):
        self._condition = threading.Condition()
        self._io_handler = IoHandler()

    @property
    def io_event(self):
        """A condition that is notified of each line."""
        return self._condition

    def track(self, process):
        with self._condition:
            self._io_handler.track(process)

    def append(self, event):
        with self._condition:
            self._io_handler.append(event)
            self._condition.notify_all()

    def __iter__(self):
        with self._condition:
            return iter(self._io_handler)

    def processes(self):
        with self._condition:
            return self._io_handler.processes()

    def process_names(self):
        with self._condition:
            return self._io_handler.process_names()

    def __getitem__(self, key):
        with self._condition:
            return self._io_handler[key]

    def waitFor(self, expected_output, process=None, cmd_args=None, *, stream=None,  # noqa: N802
                strict_proc_matching=True, output_filter=None, timeout=10, strip_ansi_escape_sequences=True):
        """
        Whether the output comes within `timeout` seconds; the arguments are those of assertInStdout.

        Without a `stream`, it may come on either, where ROS 2 looks at 'stderr'.
        """

        def is_in(one):
            try:
                assertInStream(self._io_handler, expected_output, process, cmd_args, output_filter=output_filter,
                               strict_proc_matching=strict_proc_matching,
                               strip_ansi_escape_sequences=strip_ansi_escape_sequences, stream=one)
            except (NoMatchingProcessException, AssertionError):
                return False
            return True

        def is_there():
            return any(is_in(one) for one in (('stderr', 'stdout') if stream is None else (stream,)))

        with self._condition:
            if self._condition.wait_for(is_there, timeout=timeout):
                return True
        try:
            resolveProcesses(self, process=process, cmd_args=cmd_args, strict_proc_matching=False)
        except NoMatchingProcessException as error:
            raise NoMatchingProcessException(
                f"After timeout, found no processes matching '{process}'. It either doesn't exist, was never launched, "
                "or didn't generate any output") from error
        return False

    def assertWaitFor(self, *args, **kwargs):  # noqa: N802
        """Fails unless waitFor() finds the output."""
        expected = kwargs.get('expected_output', args[0] if args else None)
        assert self.waitFor(*args, **kwargs), f'Waiting for output timed out: {expected!r}'

    def assertWaitForStream(self, *args, stream, **kwargs):  # noqa: N802
        """The same for 'stdout' or 'stderr'."""
        self.assertWaitFor(*args, stream=stream, **kwargs)
