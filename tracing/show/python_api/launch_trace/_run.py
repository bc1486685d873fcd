# SPDX-License-Identifier: Apache-2.0
"""An analysed trace: its tables and chains. docs/tables.md says what each table holds."""

from __future__ import annotations

import html
from os import PathLike, fspath
from typing import Any, Sequence, overload

from . import _tables
from ._chain import Chain, find_paths, named_chain
from ._plot import Plots
from ._table import Column, Table


class _TableOf:
    """The table with the name of the attribute, which is made when it is first asked for."""

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    @overload
    def __get__(self, run: None, owner: type) -> _TableOf: ...

    @overload
    def __get__(self, run: Run, owner: type) -> Table: ...

    def __get__(self, run: Run | None, owner: type) -> _TableOf | Table:
        return self if run is None else run.table(self._name)


class Run:
    """What happened in a trace. Every table of docs/tables.md is an attribute, such as `run.messages`."""

    schema_version = _TableOf()
    trace = _TableOf()
    verdict = _TableOf()
    remarks = _TableOf()
    findings = _TableOf()
    losses = _TableOf()
    event_counts = _TableOf()
    tracing_cost = _TableOf()
    starts = _TableOf()
    launcher_events = _TableOf()
    hosts = _TableOf()
    processes = _TableOf()
    threads = _TableOf()
    nodes = _TableOf()
    topics = _TableOf()
    publishers = _TableOf()
    subscriptions = _TableOf()
    timers = _TableOf()
    services = _TableOf()
    clients = _TableOf()
    executors = _TableOf()
    callback_groups = _TableOf()
    simulated_times = _TableOf()
    callbacks = _TableOf()
    callback_instances = _TableOf()
    allocations = _TableOf()
    messages = _TableOf()
    calls = _TableOf()
    goals = _TableOf()
    executor_waits = _TableOf()
    lifecycle_states = _TableOf()
    thread_states = _TableOf()
    chains = _TableOf()
    chain_steps = _TableOf()
    chain_instances = _TableOf()
    chain_hops = _TableOf()
    callback_statistics = _TableOf()
    topic_statistics = _TableOf()
    subscription_statistics = _TableOf()
    call_statistics = _TableOf()
    actions = _TableOf()
    node_statistics = _TableOf()
    executor_statistics = _TableOf()
    execution_statistics = _TableOf()
    lifecycle_statistics = _TableOf()
    unmatched = _TableOf()

    def __init__(self, directories: Sequence[str | PathLike[str]], all: bool = False) -> None:
        self.directories = [fspath(directory) for directory in directories]
        self._system = _tables.System(self.directories, all)
        self._known: dict[str, Table] = {}

    @property
    def tables(self) -> list[str]:
        """The names of all tables."""
        return list(_tables.NAMES)

    @property
    def error(self) -> str:
        """Why reading stopped early, or what data is missing; '' when all was read."""
        return str(self._system.error)

    @property
    def warnings(self) -> list[str]:
        return list(self._system.warnings)

    def table(self, name: str) -> Table:
        if name not in self._known:
            if name not in _tables.NAMES:
                raise KeyError(f"there is no table '{name}'; the tables are {', '.join(self.tables)}")
            columns = self._system.columns(name)
            self._known[name] = Table(
                name, {part[0]: Column(part[1], part[2], part[3]) for part in columns.parts()}, columns.rows,
                self._system.help(name), columns.stream)
        return self._known[name]

    def chain(self, *names: str) -> Chain:
        """The chain with a name that the launch file gives it, or from one node or topic to another.

        With a topic, the chain begins with the callback that publishes it, and ends with the callback that gets it, or
        with the one that publishes it if nobody in the trace gets it. If several ways lead from one to the other, it is
        the one that was gone through most often; `paths()` gives all of them.
        """
        if len(names) == 1:
            return named_chain(self, names[0])
        return self.paths(*names)[0]

    def paths(self, *names: str) -> list[Chain]:
        """All ways from the first node or topic to the last one, through those between; the most frequent first."""
        if len(names) < 2:
            raise TypeError('paths() takes the first and the last node or topic, and what is between')
        return find_paths(self, names)

    @property
    def plot(self) -> Plots:
        """Pictures of the trace, drawn by matplotlib."""
        return Plots(self)

    def __repr__(self) -> str:
        (events, begin, end), = self.trace.rows('events', 'begin_ns', 'end_ns')
        seconds = 0 if begin is None else (end - begin) / 1e9
        error = f', {self.error}' if self.error else ''
        return f'<Run {self.directories[0]}: {events} events in {seconds:.1f} s{error}>'

    def _repr_html_(self) -> str:
        findings = ''.join(f'<li>{html.escape(kind)}: {html.escape(subject or "")}, {html.escape(figures or "")}</li>'
                           for kind, subject, figures in self.findings.rows('kind', 'subject', 'figures'))
        return f'<p><b>{html.escape(repr(self)[1:-1])}</b></p><ul>{findings}</ul>'

    def __dir__(self) -> list[Any]:
        return sorted({*super().__dir__(), *self.tables})
