# SPDX-License-Identifier: Apache-2.0
"""Reads the traces of LTTng: event by event, into columns, or as tables of what happened.

    run = launch_trace.open('traces/run')                 # analysed: docs/python_analysis.md
    run.callback_instances.to_pandas()
    run.chain('/scan', '/cmd_vel').plot()

    for event in launch_trace.Trace('traces/run').events('ros2:callback_*'):   # events: docs/trace_reader.md
        print(event.time_ns, event.name, event['callback'])
    starts = launch_trace.Trace('traces/run').columns('ros2:callback_start', ['time_ns', 'callback'])
"""

from __future__ import annotations

from os import PathLike
from typing import TYPE_CHECKING, Sequence

from ._events import Event, Loss, Trace, TraceError

if TYPE_CHECKING:
    from ._run import Run

__all__ = ['Event', 'Loss', 'Trace', 'TraceError', 'open']

for _type in (Loss, Trace):
    _type.__module__ = __name__


def open(directories: str | PathLike[str] | Sequence[str | PathLike[str]], *, all: bool = False) -> Run:
    """Reads and analyses the traces at and below a directory, or a list of directories, as one.

    Of the recording of a launch, only the processes of the launch are read; with `all`, those of others, too.
    Raises TraceError when there is nothing to read. Where a trace is damaged or incomplete, `error` of the result says so.
    """
    from ._run import Run  # nobody who reads events alone waits for it
    paths = [directories] if isinstance(directories, (str, PathLike)) else list(directories)
    if not paths:
        raise ValueError('no directory is given')
    return Run(paths, all)
