# SPDX-License-Identifier: Apache-2.0
"""The pictures of the experiment: the paper's figures 7, 8 and 9, for two processes and for one."""

from .drawing import Chart, legend, number
from .paper import MEAN_OVERHEAD_US


def _of(experiment, processes):
    return [one for one in experiment['combinations'] if one['processes'] == processes]


def _axes(combinations):
    return sorted({one['bytes'] for one in combinations}), sorted({one['rate'] for one in combinations})


def _offset(series, count):
    return (series - (count - 1) / 2) * 0.2


def _at(combinations, size, rate):
    return next((one for one in combinations if (one['bytes'], one['rate']) == (size, rate)), None)


def _name(one):
    return f"{one['bytes'] // 1024} KiB, {one['rate']} Hz"


def latencies(experiment, processes):
    """Figure 7: the latencies of each combination, without tracing and with it."""
    combinations = _of(experiment, processes)
    sizes, rates = _axes(combinations)
    summaries = [one[side] for one in combinations for side in ('untraced', 'traced')]
    low, high = min(one['least'] for one in summaries), max(one['most'] for one in summaries)
    charts = []
    for side, title in (('untraced', 'Without tracing'), ('traced', 'With tracing')):
        chart = Chart(title, 'latency (µs)', 'messages a second (Hz)', [str(rate) for rate in rates], low, high, True)
        for series, size in enumerate(sizes):
            for place, rate in enumerate(rates):
                one = _at(combinations, size, rate)
                if one:
                    summary = one[side]
                    chart.box(place, _offset(series, len(sizes)), summary, series, (
                        f"{_name(one)}: mean {number(summary['mean'])} µs, median {number(summary['p50'])}, quartiles "
                        f"{number(summary['p25'])} and {number(summary['p75'])}, least {number(summary['least'])}, most "
                        f"{number(summary['most'])}; {summary['messages']} messages, {summary['outliers']} outliers"))
        charts.append(chart.svg())
    return charts, legend([f'{size // 1024} KiB' for size in sizes])


def overheads(experiment, processes, which='overhead_of_mean'):
    """Figure 8: what tracing adds to each combination, in microseconds and in percent."""
    combinations = _of(experiment, processes)
    sizes, rates = _axes(combinations)
    charts = []
    for unit, factor, label, title in (('us', 1, 'added latency (µs)', 'Absolute'),
                                       ('part', 100, 'added latency (%)', 'Relative')):
        values = {(one['bytes'], one['rate']): {key: factor * value for key, value in one[which][unit].items()}
                  for one in combinations}
        low = min(0, *(one['low'] for one in values.values()))
        high = max(one['high'] for one in values.values())
        if unit == 'us':
            high = max(high, MEAN_OVERHEAD_US)
        chart = Chart(title, label, 'messages a second (Hz)', [str(rate) for rate in rates], low, high)
        for series, size in enumerate(sizes):
            estimates = [values.get((size, rate)) for rate in rates]
            abouts = [f"{size // 1024} KiB, {rate} Hz: {number(one['value'])} ({number(one['low'])} to {number(one['high'])})"
                      for rate, one in zip(rates, estimates) if one]
            chart.line(estimates, series, abouts, _offset(series, len(sizes)) / 2)
        if unit == 'us':
            chart.level(MEAN_OVERHEAD_US, 'mean of the paper')
        charts.append(chart.svg())
    return charts, legend([f'{size // 1024} KiB' for size in sizes])


def aggregate(experiment):
    """Figure 9: all messages, less the untraced mean of their combination."""
    sides = [(processes, side, one[side]) for processes, one in sorted(experiment['aggregates'].items(), reverse=True)
             for side in ('untraced', 'traced')]
    places = [f"{'two processes' if processes == '2' else 'one process'}, {side}" for processes, side, _ in sides]
    low, high = min(one['p5'] for *_, one in sides), max(one['p95'] for *_, one in sides)
    chart = Chart('All combinations, less the untraced mean', 'difference (µs)', 'processes; box: quartiles; bars: 5 to 95 %',
                  [place.replace(' processes', '').replace(' process', '') for place in places],
                  low, max(high, MEAN_OVERHEAD_US))
    for place, (processes, side, one) in enumerate(sides):
        chart.box(place, 0, {**one, 'least': one['p5'], 'most': one['p95']}, 0 if side == 'untraced' else 1, (
            f"{places[place]}: mean {number(one['mean'])} µs, quartiles {number(one['p25'])} and {number(one['p75'])}; least "
            f"{number(one['least'])}, most {number(one['most'])}"))
    chart.level(MEAN_OVERHEAD_US, 'mean of the paper')
    return chart.svg()
