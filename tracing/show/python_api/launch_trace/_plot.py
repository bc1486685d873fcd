# SPDX-License-Identifier: Apache-2.0
"""The usual pictures, drawn by matplotlib. Each function returns the axes, which a notebook shows."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Sequence

from ._chain import Chain, Hop, nearest_rank
from ._table import needed

if TYPE_CHECKING:
    from ._run import Run

PERCENTS = (50, 90, 99, 100)


MOST_COLOURS = 9  # matplotlib has ten; the rest is grey
LONGEST_TITLE = 60


def _axes(ax: Any) -> Any:
    if ax is not None:
        return ax
    return needed('matplotlib.pyplot', 'a plot').subplots(figsize=(10, 5), constrained_layout=True)[1]


def _legend_beside(ax: Any) -> None:
    ax.legend(fontsize='small', loc='center left', bbox_to_anchor=(1.0, 0.5))


def _title(chain: Chain) -> str:
    if len(chain.name) <= LONGEST_TITLE:
        return chain.name
    return f'{chain.steps[0].node} → … → {chain.steps[-1].node} ({len(chain.steps)} callbacks)'


def _colours(sums: dict[str, float]) -> dict[str, dict[str, Any]]:
    """For each part how it is drawn: the largest ones have colours of their own, and stand in the legend."""
    largest = sorted(sums, key=lambda label: -sums[label])[:MOST_COLOURS]
    styles: dict[str, dict[str, Any]] = {}
    for label in sums:
        if label in largest:
            styles[label] = {'color': f'C{len([one for one in styles if one in largest])}', 'label': label}
        else:
            styles[label] = {'color': 'lightgrey'}
    if rest := len(sums) - len(largest):
        styles[next(label for label in sums if label not in largest)]['label'] = f'{rest} shorter parts'
    for style in styles.values():
        if style['color'] == 'C7':
            style['color'] = f'C{MOST_COLOURS}'  # grey is for the rest
    return styles


class Plots:
    """`run.plot`. Times of the axes are seconds since the begin of the trace, and milliseconds."""

    def __init__(self, run: Run) -> None:
        self._run = run
        self._begin_ns = run.trace.to_list('begin_ns')[0] or 0

    def _seconds(self, times_ns: Sequence[int]) -> list[float]:
        return [(time - self._begin_ns) / 1e9 for time in times_ns]

    def latencies_ns(self, topic: str) -> dict[str, list[tuple[int, int]]]:
        """By the node that got the messages: when each was published, and how long it took to its callback."""
        run = self._run
        topics = run.topics.to_list('name')
        if topic not in topics:
            raise KeyError(f"no topic is named '{topic}'; the topics are {', '.join(topics)}")
        nodes = run.nodes.to_list('name')
        ends = run.subscriptions.to_list('node')
        found: dict[str, list[tuple[int, int]]] = {}
        wanted = topics.index(topic)
        for of, subscription, published, callback in run.messages.rows('topic', 'subscription', 'published_ns',
                                                                       'callback_ns'):
            if of == wanted and callback is not None:
                node = ends[subscription]
                name = '?' if node is None else nodes[node]
                found.setdefault(name, []).append((published, callback - published))
        return found

    def durations_ns(self, node: str) -> dict[str, list[tuple[int, int]]]:
        """By callback of the node: the start of each run, and how long it took."""
        run = self._run
        nodes = run.nodes.to_list('name')
        if node not in nodes:
            raise KeyError(f"no node is named '{node}'; the nodes are {', '.join(nodes)}")
        labels = {callback: label for callback, label in self._labels().items() if label.startswith(f'{node}, ')}
        found: dict[str, list[tuple[int, int]]] = {}
        for callback, start, duration in run.callback_instances.rows('callback', 'start_ns', 'duration_ns'):
            if callback in labels and duration is not None:
                found.setdefault(labels[callback], []).append((start, duration))
        return found

    def _labels(self) -> dict[int, str]:
        """What each callback is called: '/node, subscription /topic'."""
        run = self._run
        nodes, topics = run.nodes.to_list('name'), run.topics.to_list('name')
        labels = {}
        for row in run.callbacks:
            what = row['kind']
            if row['topic'] is not None:
                what += ' ' + topics[row['topic']]
            elif row['period_ns'] is not None:
                what += f" {row['period_ns'] / 1e6:g} ms"
            elif row['service'] is not None:
                what += ' ' + row['service']
            labels[row['id']] = f"{'?' if row['node'] is None else nodes[row['node']]}, {what}"
        return labels

    def _values(self, name: str) -> tuple[dict[str, list[tuple[int, int]]], str]:
        if name in self._run.topics.to_list('name'):
            return self.latencies_ns(name), f'latency of {name}'
        return self.durations_ns(name), f'duration of callbacks of {name}'

    def over_time(self, name: str, ax: Any = None) -> Any:
        """The latency of each message of a topic, or the duration of each callback of a node."""
        values, title = self._values(name)
        ax = _axes(ax)
        for label, points in values.items():
            ax.plot(self._seconds([time for time, _ in points]), [value / 1e6 for _, value in points], '.',
                    markersize=3, label=label)
        ax.set(xlabel='s', ylabel='ms', title=title)
        if values:
            ax.legend()
        return ax

    latency = over_time

    def histogram(self, name: str, bins: int = 50, ax: Any = None) -> Any:
        """The same values as a histogram."""
        values, title = self._values(name)
        ax = _axes(ax)
        for label, points in values.items():
            ax.hist([value / 1e6 for _, value in points], bins=bins, alpha=0.6, label=label)
        ax.set(xlabel='ms', ylabel='number', title=title)
        if values:
            ax.legend()
        return ax

    def chain(self, chain: Chain, ax: Any = None) -> Any:
        """A stacked bar for each percentile of the response: that of the instance which has this rank, so that its parts
        add up to it."""
        ways = sorted(chain.first_ways(), key=lambda way: way[1] - way[0])
        ax = _axes(ax)
        bars = [(f'p{percent}' if percent < 100 else 'max', ways[_rank(len(ways), percent)]) for percent in PERCENTS if ways]
        bottoms = [0.0] * len(bars)
        parts = [chain.parts(way[3]) for _, way in bars]
        styles = _colours({label: float(sum(of[place][1] for of in parts if place < len(of)))
                           for place, (label, _) in enumerate(parts[-1] if parts else [])})
        for place, (label, style) in enumerate(styles.items()):
            heights = [of[place][1] / 1e6 if place < len(of) else 0.0 for of in parts]
            ax.bar([name for name, _ in bars], heights, bottom=bottoms, **style)
            bottoms = [bottom + height for bottom, height in zip(bottoms, heights)]
        ax.set(ylabel='ms', title=_title(chain))
        if styles:
            _legend_beside(ax)
        return ax

    def message_flow(self, chain: Chain, count: int = 50, ax: Any = None) -> Any:
        """A line for each of the last `count` instances, from callback to callback."""
        ax = _axes(ax)
        for begin, end, _, hops in chain.first_ways()[-count:]:
            times: list[int] = []
            places: list[float] = []
            for place, hop in enumerate(hops):
                times += [hop.begin_ns, hop.begin_ns + (hop.duration_ns or 0)]
                places += [float(place), float(place)]
            ax.plot(self._seconds(times), places, linewidth=1)
        ax.set_yticks(range(len(chain.steps)), [f'{step.node}, {step.callback}' for step in chain.steps])
        ax.invert_yaxis()
        ax.set(xlabel='s')
        ax.set_title(f'message flow of {_title(chain)}', loc='right')  # the names on the left are long
        return ax

    def scheduling(self, begin_s: float | None = None, seconds: float = 1.0, ax: Any = None) -> Any:
        """Which callback ran when in which thread, from `begin_s` seconds after the begin of the trace on, or else from the
        first callback on."""
        run = self._run
        ax = _axes(ax)
        if begin_s is None:
            begin_s = (min(run.callback_instances.to_list('start_ns'), default=self._begin_ns) - self._begin_ns) / 1e9
        first = self._begin_ns + begin_s * 1e9
        last = first + seconds * 1e9
        labels = self._labels()
        names = run.processes.to_list('name')
        threads = [f"{names[row['process']] or 'thread'} [{row['vtid']}]" for row in run.threads]
        bars: dict[int, dict[int, list[tuple[float, float]]]] = {}
        for callback, thread, start, duration in run.callback_instances.rows('callback', 'thread', 'start_ns',
                                                                             'duration_ns'):
            if duration is not None and start < last and start + duration > first:
                bars.setdefault(callback, {}).setdefault(thread, []).append(((start - self._begin_ns) / 1e9, duration / 1e9))
        rows = {thread: row for row, thread in enumerate(sorted({thread for of in bars.values() for thread in of}))}
        for number, (callback, by_thread) in enumerate(sorted(bars.items())):
            for thread, spans in by_thread.items():
                ax.broken_barh(spans, (rows[thread] - 0.4, 0.8), color=f'C{number % 10}')
            ax.plot([], [], color=f'C{number % 10}', linewidth=6, label=labels[callback])
        ax.set_yticks(list(rows.values()), [threads[thread] for thread in rows])
        ax.set(xlabel='s', title='callbacks in threads')
        if bars:
            _legend_beside(ax)
        return ax

    def outliers(self, chain: Chain, count: int = 10, ax: Any = None) -> Any:
        """The slowest instances: how much longer than usually (at the median) each part of them took."""
        ax = _axes(ax)
        usual, slowest = outlier_parts(chain, count)
        bottoms = [0.0] * len(slowest)
        names = [f'{second:.3f} s' for second in self._seconds([begin for begin, _ in slowest])]
        above = {label: [max(parts.get(label, 0) - usual[label], 0) / 1e6 for _, parts in slowest] for label in usual}
        for label, style in _colours({label: sum(heights) for label, heights in above.items()}).items():
            heights = above[label]
            ax.barh(names, heights, left=bottoms, **style)
            bottoms = [bottom + height for bottom, height in zip(bottoms, heights)]
        ax.invert_yaxis()
        ax.set(xlabel='ms above the median of the part', title=f'slowest of {_title(chain)}')
        if usual:
            _legend_beside(ax)
        return ax


def _rank(count: int, percent: float) -> int:
    return min(max(int(-(-count * percent // 100)), 1), count) - 1


def outlier_parts(chain: Chain, count: int) -> tuple[dict[str, float], list[tuple[int, dict[str, int]]]]:
    """The median of each part, and the begin and the parts of the slowest instances."""
    def sums(hops: Sequence[Hop]) -> dict[str, int]:
        return dict(chain.parts(hops))

    ways = sorted(chain.first_ways(), key=lambda way: way[0] - way[1])
    values: dict[str, list[int]] = {}
    for way in ways:
        for label, value in chain.parts(way[3]):
            values.setdefault(label, []).append(value)
    usual = {label: nearest_rank(of, 50) or 0 for label, of in values.items()}
    return usual, [(way[0], sums(way[3])) for way in ways[:count]]
