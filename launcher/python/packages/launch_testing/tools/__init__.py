# SPDX-License-Identifier: Apache-2.0
"""Processes that a test starts itself, and comparisons of output."""

import contextlib
import os
import re

from launch import LaunchDescription, _names
from launch.events import IncludeLaunchDescription
from launch.events.process import ProcessExited, ProcessStarted, ShutdownProcess, matches_action


def get_default_filtered_prefixes():
    return ['pid', 'rc']


def get_default_filtered_patterns():
    return []


def normalize_lineseps(lines):
    r"""A text in which each line ends with '\n', also what a terminal has ended with '\r\n'."""
    return lines.replace(os.linesep, '\n').replace('\r\n', '\n')


def basic_output_filter(filtered_prefixes=None, filtered_patterns=None):
    """A function that removes the lines that begin with a prefix or match a pattern."""
    prefixes = tuple(get_default_filtered_prefixes() if filtered_prefixes is None else filtered_prefixes)
    patterns = [re.compile(pattern) for pattern in (
        get_default_filtered_patterns() if filtered_patterns is None else filtered_patterns)]

    def filtered(output):
        return ''.join(line for line in output.splitlines(keepends=True)
                       if not line.startswith(prefixes) and not any(each.match(line) for each in patterns))

    return filtered


def expected_output_from_file(path, encoding=None):
    """The lines of PATH.txt, or the patterns of the lines of PATH.regex, for expect_output()."""
    if os.path.isfile(path + '.txt'):
        with open(path + '.txt', encoding=encoding) as file:
            return file.read().splitlines()
    if os.path.isfile(path + '.regex'):
        with open(path + '.regex', 'rb' if encoding is None else 'r', encoding=encoding) as file:
            return [re.compile(line if isinstance(line, str) else line.decode()) for line in file.read().splitlines()]
    raise RuntimeError(f"could not find output check file: neither '{path}.txt' nor '{path}.regex' is there")


def expect_output(*, expected_lines=None, expected_text=None, lines=None, text=None, strict=False):
    """Whether a text, or a list of lines, is what is expected. Unless `strict`, other lines may stand between."""
    if (lines is None) == (text is None) or (expected_lines is None) == (expected_text is None):
        raise ValueError('give one of lines and text, and one of expected_lines and expected_text')
    if expected_text is not None:
        actual = text if text is not None else '\n'.join(lines)
        if hasattr(expected_text, 'search'):
            return (expected_text.fullmatch(actual) if strict else expected_text.search(actual)) is not None
        return actual == expected_text if strict else expected_text in actual
    left = list(lines) if lines is not None else text.splitlines()

    def fits(expected, line):
        return expected.match(line) is not None if hasattr(expected, 'match') else expected == line

    if strict:
        return len(left) == len(expected_lines) and all(map(fits, expected_lines, left))
    remaining = iter(left)
    return all(any(fits(expected, line) for line in remaining) for expected in expected_lines)


class ProcessProxy:
    """A process that a test has started."""

    def __init__(self, process_action, proc_info, proc_output, *, output_filter=None):
        if output_filter is not None and not callable(output_filter):
            raise TypeError(f"Expected 'output_filter' to be callable but got '{output_filter!r}'")
        self._action = process_action
        self._proc_info = proc_info
        self._proc_output = proc_output
        self._filter = output_filter or (lambda text: text)

    def wait_for_shutdown(self, timeout=None):
        """Whether it ends within `timeout` seconds; None: without a limit."""
        with self._proc_info.proc_event:
            return self._proc_info.proc_event.wait_for(lambda: self.terminated, timeout=timeout)

    def wait_for_output(self, condition=None, timeout=None):
        """Whether it writes something that the function accepts, within `timeout` seconds."""
        accepts = condition or (lambda output: bool(output))
        if not callable(accepts):
            raise TypeError(f"Expected 'condition' to be callable but got '{condition!r}'")
        with self._proc_output.io_event:
            return self._proc_output.io_event.wait_for(lambda: accepts(self.output), timeout=timeout)

    @property
    def target_process_action(self):
        return self._action

    def _text(self, wanted):
        if self._action not in self._proc_output.processes():
            return ''
        return self._filter(''.join(line.text.decode(errors='replace') for line in self._proc_output[self._action]
                                    if wanted(line)))

    @property
    def stdout(self):
        return self._text(lambda line: line.from_stdout)

    @property
    def stderr(self):
        return self._text(lambda line: line.from_stderr)

    @property
    def output(self):
        return self._text(lambda line: True)

    def _last_event(self):
        return self._proc_info[self._action] if self._action in self._proc_info.processes() else None

    @property
    def running(self):
        return isinstance(self._last_event(), ProcessStarted)

    @property
    def terminated(self):
        return isinstance(self._last_event(), ProcessExited)

    @property
    def exit_code(self):
        return self._proc_info[self._action].returncode


@contextlib.contextmanager
def launch_process(launch_service, process_action, proc_info, proc_output, **kwargs):
    """Starts the process beside the others, and ends it at the end of the block."""
    launch_service.emit_event(IncludeLaunchDescription(launch_description=LaunchDescription([process_action])))
    proxy = ProcessProxy(process_action, proc_info, proc_output, **kwargs)
    try:
        yield proxy
    finally:
        if not proxy.terminated:
            launch_service.emit_event(ShutdownProcess(process_matcher=matches_action(process_action)))


_names.same_module(__name__, f'{__name__}.output', f'{__name__}.process', f'{__name__}.text')
