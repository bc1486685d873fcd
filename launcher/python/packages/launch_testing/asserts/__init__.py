# SPDX-License-Identifier: Apache-2.0
"""Assertions on exits and on output."""

import contextlib
import re

from launch_testing.util import NO_CMD_ARGS, resolveProcesses

__unittest = True  # tracebacks of tests end at the test

EXIT_OK = 0
EXIT_SIGINT = 130
EXIT_SIGQUIT = 131
EXIT_SIGKILL = 137
EXIT_SIGSEGV = 139

_ESCAPES = re.compile(r'\x1b(?:\[[0-?]*[ -/]*[@-~]|[@-Z\\-_])')


def assertExitCodes(proc_info, allowable_exit_codes=(EXIT_OK,), process=None, cmd_args=None, *,  # noqa: N802
                    strict_proc_matching=True):
    """All of these processes have ended with one of the codes; -N stands for signal N."""
    for code in allowable_exit_codes:
        assert isinstance(code, int), f'Provided exit code {code} is not an int'
    for found in resolveProcesses(proc_info, process=process, cmd_args=cmd_args,
                                  strict_proc_matching=strict_proc_matching):
        event = proc_info[found]
        assert hasattr(event, 'returncode'), f'Proc {event.process_name} has not ended'
        assert event.returncode in allowable_exit_codes, (
            f'Proc {event.process_name} exited with code {event.returncode}')


def _lines_in_order(expected, actual):
    lines = iter(actual.splitlines())
    return all(line in lines for line in expected)


def _patterns_in_order(expected, actual):
    at = 0
    for pattern in expected:
        match = pattern.search(actual, at)
        if match is None:
            return False
        at = match.end()
    return True


def is_in(expected, actual):
    """Whether a text holds what is expected: a text, a regular expression, or a list of lines or expressions."""
    if isinstance(expected, str):
        return expected in actual
    if hasattr(expected, 'search'):
        return expected.search(actual) is not None
    if isinstance(expected, (list, tuple)) and expected:
        if isinstance(expected[0], str):
            return _lines_in_order(expected, actual)
        if hasattr(expected[0], 'search'):
            return _patterns_in_order(expected, actual)
    raise ValueError('Unknown format for expected output')


def assertInStream(proc_output, expected_output, process, cmd_args=None, *, output_filter=None,  # noqa: N802
                   strict_proc_matching=True, strip_ansi_escape_sequences=True, stream):
    """One of the processes has written what is expected to 'stdout' or 'stderr'."""
    if stream not in ('stdout', 'stderr'):
        raise ValueError(f"stream must be 'stdout' or 'stderr', not {stream!r}")
    if output_filter is not None and not callable(output_filter):
        raise ValueError('output_filter is not callable')
    found = resolveProcesses(proc_output, process=process or None, cmd_args=cmd_args,
                             strict_proc_matching=strict_proc_matching)
    for each in found:
        text = ''.join(line.text.decode(errors='replace') for line in proc_output[each]
                       if getattr(line, 'from_' + stream))
        if strip_ansi_escape_sequences:
            text = _ESCAPES.sub('', text)
        if output_filter is not None:
            text = output_filter(text)
        if is_in(expected_output, text):
            return
    names = ', '.join(sorted(each.process_details['name'] for each in found))
    raise AssertionError(f"Did not find '{expected_output}' in output for any of the matching processes: {names}")


def assertInStdout(proc_output, expected_output, process, cmd_args=None, **options):  # noqa: N802
    assertInStream(proc_output, expected_output, process, cmd_args, stream='stdout', **options)


def assertInStderr(proc_output, expected_output, process, cmd_args=None, **options):  # noqa: N802
    assertInStream(proc_output, expected_output, process, cmd_args, stream='stderr', **options)


class SequentialTextChecker:
    """Finds texts one behind the other."""

    def __init__(self, output):
        self._text = ''.join(output)
        self._at = 0

    def assertInText(self, msg):  # noqa: N802
        found = self._text.find(msg, self._at)
        if found < 0:
            raise AssertionError(f"'{msg}' not found in sequence after previous match.  "
                                 f'The output near the last matched line:\n{self.get_nearby_lines()}')
        self._at = found + len(msg)

    assertInStdout = assertInText  # noqa: N815

    def get_nearby_lines(self):
        """The lines around the last match."""
        before = self._text[:self._at].splitlines(keepends=True)[-3:]
        after = self._text[self._at:].splitlines(keepends=True)[:3]
        return ''.join([*before, *after]).rstrip('\n')


@contextlib.contextmanager
def assertSequentialStdout(proc_output, process, cmd_args=None):  # noqa: N802
    """Gives an object whose assertInStdout(text) finds each text behind the one before."""
    found = resolveProcesses(proc_output, process=process, cmd_args=cmd_args)[0]
    yield SequentialTextChecker(
        [line.text.decode(errors='replace') for line in proc_output[found] if line.from_stdout])


__all__ = ['EXIT_OK', 'EXIT_SIGINT', 'EXIT_SIGKILL', 'EXIT_SIGQUIT', 'EXIT_SIGSEGV', 'NO_CMD_ARGS',
           'SequentialTextChecker', 'assertExitCodes', 'assertInStderr', 'assertInStdout', 'assertInStream',
           'assertSequentialStdout']
