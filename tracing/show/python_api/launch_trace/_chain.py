# SPDX-License-Identifier: Apache-2.0
"""A chain of callbacks, with each time that something went through it."""

from __future__ import annotations

import html
from typing import TYPE_CHECKING, Any, NamedTuple, Sequence

from ._table import Column, Table

if TYPE_CHECKING:
    from ._run import Run

PARTS = ('callback', 'transport', 'executor', 'take')


def nearest_rank(values: Sequence[float], percent: float) -> float | None:
    """The smallest value that at least this part of all does not exceed, as in the report."""
    ordered = sorted(values)
    if not ordered:
        return None
    rank = -(-len(ordered) * percent // 100)
    return ordered[min(max(int(rank), 1), len(ordered)) - 1]


class Step(NamedTuple):
    node: str
    callback: str  # what calls it: 'timer 100 ms', 'subscription /ping'
    topic: str | None  # that led here
    callback_id: int  # in `callbacks`


class Hop(NamedTuple):
    """A callback on the way of one instance, and the way to it."""

    callback_instance: int | None
    begin_ns: int
    duration_ns: int | None
    until_publish_ns: int | None
    transfer_ns: int | None
    executor_ns: int | None
    take_ns: int | None
    message: int | None


class Chain:
    """Callbacks that follow from one another. `instances` has a row for each time, `hops` one for each callback of it."""

    def __init__(self, run: Run, name: str, steps: Sequence[Step],
                 ways: Sequence[tuple[int, int, bool, Sequence[Hop]]]) -> None:
        self._run = run
        self.name = name
        self.steps = list(steps)
        self._ways = list(ways)

    def __len__(self) -> int:
        return len(self._ways)

    @property
    def instances(self) -> Table:
        """From an input, a begin of the first callback, to an output, an end of the last one. `first` is 1 for the first
        output of an input, which is a response."""
        ways = self._ways
        columns = {
            'id': Column(list(range(len(ways)))),
            'begin_ns': Column([way[0] for way in ways]),
            'end_ns': Column([way[1] for way in ways]),
            'response_ns': Column([way[1] - way[0] for way in ways]),
            'first': Column([int(way[2]) for way in ways]),
        }
        return Table(f'instances of {self.name}', columns, len(ways))

    @property
    def hops(self) -> Table:
        """A row for each callback of each instance, with the times of the way to it."""
        rows = [(instance, step, *hop) for instance, way in enumerate(self._ways) for step, hop in enumerate(way[3])]
        names = ('instance', 'step', *Hop._fields)
        values = list(zip(*rows)) or [()] * len(names)
        return Table(f'hops of {self.name}', {name: Column(list(of)) for name, of in zip(names, values)}, len(rows))

    @property
    def responses_ns(self) -> list[int]:
        """From each input to the first output that it caused."""
        return [way[1] - way[0] for way in self._ways if way[2]]

    def summary(self) -> dict[str, Any]:
        """Of the responses; percentiles are nearest ranks."""
        responses = self.responses_ns
        return {'count': len(responses), 'p50_ns': nearest_rank(responses, 50), 'p90_ns': nearest_rank(responses, 90),
                'p99_ns': nearest_rank(responses, 99), 'max_ns': max(responses, default=None)}

    def parts(self, way: Sequence[Hop]) -> list[tuple[str, int]]:
        """Where the time of one instance went: of each step its label and nanoseconds, which add up to the response."""
        parts: list[tuple[str, int]] = []
        for step, hop in zip(self.steps[1:], way[1:]):
            if hop.until_publish_ns is None or hop.transfer_ns is None:
                continue
            parts.append((f'{step.topic}: until publish', hop.until_publish_ns))
            known = (hop.executor_ns or 0) + (hop.take_ns or 0)
            parts.append((f'{step.topic}: on the way', hop.transfer_ns - known))
            if hop.executor_ns is not None:
                parts.append((f'{step.topic}: executor', hop.executor_ns))
            if hop.take_ns is not None:
                parts.append((f'{step.topic}: take', hop.take_ns))
        if way and way[-1].duration_ns is not None:
            parts.append((f'{self.steps[-1].node}: callback', way[-1].duration_ns))
        return parts

    def first_ways(self) -> list[tuple[int, int, bool, Sequence[Hop]]]:
        return [way for way in self._ways if way[2]]

    def plot(self, ax: Any = None) -> Any:
        """Stacked bars: where the time went, at several percentiles."""
        return self._run.plot.chain(self, ax=ax)

    def plot_flow(self, count: int = 50, ax: Any = None) -> Any:
        """Lines from callback to callback over time."""
        return self._run.plot.message_flow(self, count=count, ax=ax)

    def __repr__(self) -> str:
        return f'<Chain {self.name}: {len(self.steps)} callbacks, {len(self)} instances>'

    def _repr_html_(self) -> str:
        def ms(value: Any) -> str:
            return '' if value is None else f'{value / 1e6:.3f}'

        rows = ''
        for place, step in enumerate(self.steps):
            transfers = [way[3][place].transfer_ns for way in self.first_ways()]
            known = [value for value in transfers if value is not None]
            cells = (step.node, step.callback, ms(nearest_rank(known, 50)), ms(nearest_rank(known, 99)))
            rows += '<tr>' + ''.join(f'<td>{html.escape(cell)}</td>' for cell in cells) + '</tr>'
        summary = self.summary()
        return (f'<p><b>{html.escape(self.name)}</b>: {summary["count"]} responses, p50 {ms(summary["p50_ns"])} ms, '
                f'p99 {ms(summary["p99_ns"])} ms</p><table><tr><th>node</th><th>callback</th>'
                f'<th>transfer p50, ms</th><th>p99</th></tr>{rows}</table>')


def _steps_of_chains(run: Run) -> dict[int, list[Step]]:
    steps: dict[int, list[Step]] = {}
    for chain, node, callback, topic, callback_id in run.chain_steps.rows('chain', 'node', 'callback', 'topic',
                                                                          'callback_id'):
        steps.setdefault(chain, []).append(Step(node or '', callback or '', topic, callback_id))
    return steps


def _hops_of_instances(run: Run, wanted: set[int]) -> dict[int, list[Hop]]:
    hops: dict[int, list[Hop]] = {}
    names = ('chain_instance', 'callback_instance', 'begin_ns', 'duration_ns', 'until_publish_ns', 'transfer_ns',
             'executor_ns', 'take_ns', 'message')
    for instance, *values in run.chain_hops.rows(*names):
        if instance in wanted:
            hops.setdefault(instance, []).append(Hop(*values))
    return hops


def _route(steps: Sequence[Step]) -> str:
    return ' → '.join(step.node for step in steps)


def named_chain(run: Run, name: str) -> Chain:
    ids = [chain for chain, known in run.chains.rows('id', 'name') if known == name]
    if not ids:
        names = sorted({known for known in run.chains.to_list('name') if known})
        raise KeyError(f"no chain is named '{name}'; named chains: {', '.join(names) or 'none'}. Two arguments find a chain "
                       'from one node or topic to another')
    steps = _steps_of_chains(run)
    chains = []
    for chain in ids:
        rows = [row for row in run.chain_instances.rows('id', 'chain', 'begin_ns', 'end_ns', 'first') if row[1] == chain]
        hops = _hops_of_instances(run, {row[0] for row in rows})
        chains.append(Chain(run, name, steps[chain], [(row[2], row[3], row[4] == 1, hops[row[0]]) for row in rows]))
    return max(chains, key=len)


class _Finder:
    """Where the names of a path are in the steps of a chain."""

    def __init__(self, run: Run, names: Sequence[str], chains: dict[int, list[Step]]) -> None:
        self._names = names
        topics = {step.topic for steps in chains.values() for step in steps}
        self._publishing: set[str] = set()  # nodes that publish the last name, which no callback gets
        if names[-1] not in topics and names[-1] in run.topics.to_list('name'):
            topic = run.topics.to_list('name').index(names[-1])
            nodes = run.nodes.to_list('name')
            self._publishing = {nodes[node] for node, of in run.publishers.rows('node', 'topic')
                                if of == topic and node is not None}

    def part(self, steps: Sequence[Step]) -> tuple[int, int] | None:
        """The first and the last step."""
        first, rest = self._names[0], self._names[1:]
        begin = next((place for place, step in enumerate(steps) if step.node == first or step.topic == first or
                      (place == 0 and step.callback == f'subscription {first}')), None)
        if begin is None:
            return None
        place = begin
        if steps[begin].topic == first and steps[begin].node != first:
            begin -= 1  # the callback that publishes it
        else:
            place += 1
        for number, name in enumerate(rest):
            is_last = number + 1 == len(rest)
            places = [at for at in range(place, len(steps)) if self._is_at(steps[at], name, is_last)]
            if not places:
                return None
            place = places[-1] if is_last else places[0]
        return begin, place

    def _is_at(self, step: Step, name: str, is_last: bool) -> bool:
        return name in (step.node, step.topic) or (is_last and step.node in self._publishing)


def find_paths(run: Run, names: Sequence[str]) -> list[Chain]:
    chains = _steps_of_chains(run)
    finder = _Finder(run, names, chains)
    parts = {chain: part for chain, steps in chains.items() if (part := finder.part(steps)) is not None}
    if not parts:
        known = sorted({_route(steps) for steps in chains.values()})
        raise KeyError(f"no chain leads from {' through '.join(names[:-1])} to {names[-1]}; the chains of the trace: "
                       + ('; '.join(known[:20]) or 'none'))
    rows = [row for row in run.chain_instances.rows('id', 'chain', 'begin_ns', 'end_ns', 'first') if row[1] in parts]
    hops = _hops_of_instances(run, {row[0] for row in rows})
    routes: dict[tuple[int, ...], tuple[list[Step], dict[tuple[int, int], tuple[int, int, bool, Sequence[Hop]]]]] = {}
    for instance, chain, _, _, first in rows:
        begin, end = parts[chain]
        way = hops[instance][begin:end + 1]
        if not way or way[-1].duration_ns is None or way[0].begin_ns is None:
            continue
        steps = chains[chain][begin:end + 1]
        _, ways = routes.setdefault(tuple(step.callback_id for step in steps), (steps, {}))
        output = way[-1].begin_ns + way[-1].duration_ns
        key = (way[0].begin_ns, output)
        if key not in ways or first == 1:
            ways[key] = (way[0].begin_ns, output, first == 1, way)
    found = [_with_first_outputs(run, steps, [ways[key] for key in sorted(ways, key=lambda key: key[1])])
             for steps, ways in routes.values()]
    return sorted(found, key=len, reverse=True)


def _with_first_outputs(run: Run, steps: list[Step], ways: list[tuple[int, int, bool, Sequence[Hop]]]) -> Chain:
    """Of the outputs of one input, the earliest one is the first."""
    inputs: set[int] = set()
    marked = []
    for begin, end, _, hops in ways:
        marked.append((begin, end, begin not in inputs, hops))
        inputs.add(begin)
    return Chain(run, _route(steps), steps, marked)
