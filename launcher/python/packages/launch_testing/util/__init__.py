# SPDX-License-Identifier: Apache-2.0
"""Finds the processes that a test means."""

import sys

from launch.action import Action
from launch.actions import ExecuteProcess
from launch_testing._known_process import name_and_arguments

__unittest = True  # tracebacks of tests end at the test

NO_CMD_ARGS = object()  # a process without arguments


class NoMatchingProcessException(Exception):  # noqa: N818  ROS 2's name
    """No process is recorded that is meant."""


def resolveProcesses(info_obj, *, process=None, cmd_args=None, strict_proc_matching=True):  # noqa: N802
    """
    The processes of `info_obj` that `process` means: an action, a part of a name, or None for all.

    `cmd_args` are arguments that they must have. If several have the name, `strict_proc_matching` makes this an error.
    """
    known = list(info_obj.processes())
    if process is None:
        if not known:
            raise NoMatchingProcessException('No data recorded for any process')
        return known
    if isinstance(process, str):
        return _by_name(known, process, cmd_args, strict_proc_matching)
    if not isinstance(process, Action) and not hasattr(process, 'process_details'):
        raise TypeError(f"proc argument must be 'ExecuteProcess' or 'str' not {type(process)}")
    if process not in known:
        raise NoMatchingProcessException(f'No data recorded for proc {name_and_arguments(process)}')
    return [process]


def _by_name(known, name, arguments, strict):
    wanted = [arguments] if isinstance(arguments, str) else arguments

    def has_arguments(process):
        words = process.process_details['cmd'][1:]
        return wanted is None or (not words if wanted is NO_CMD_ARGS else all(word in words for word in wanted))

    found = [process for process in known if name in process.process_details['name'] and has_arguments(process)]
    names = ', '.join(sorted(name_and_arguments(process) for process in known))
    if not found:
        raise NoMatchingProcessException(
            f"Did not find any processes matching name '{name}' and args '{arguments}'. Procs: {names}")
    if strict and len(found) > 1:
        raise Exception(f"Found multiple processes matching name '{name}' and cmd_args '{arguments}'. Procs: {names}")
    return found


def KeepAliveProc():  # noqa: N802  ROS 2's name
    """A process that runs until the launch ends."""
    return ExecuteProcess(name='keep_alive_proc', cmd=[sys.executable or '/usr/bin/python3', '-IS', '-c', (
        'import signal\nsignal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])\nsignal.sigwait([signal.SIGINT])')])
