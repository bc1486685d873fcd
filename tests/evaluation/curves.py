# SPDX-License-Identifier: Apache-2.0
"""
The pictures of figures that make a curve: losses by rate and buffers, start and stop by the number of processes, the time of
a message by that of idle subscriptions.
"""

import re

from .drawing import Chart, legend, number


def _points(figures, pattern):
    """The figures whose names match, by the groups of the pattern: {series: {x: figure}}, x being a number."""
    series = {}
    for one in figures:
        found = re.fullmatch(pattern, one['name'])
        if found:
            series.setdefault(found['series'], {})[int(found['x'])] = one
    return series


def _about(x, one):
    return f"{x:,}: {number(one['value'])} {one['unit'].replace('us', 'µs')} ({number(one['low'])} to {number(one['high'])})"


def losses(figures):
    """The part of the events that is lost, by events a second; a line for each size of buffers."""
    series = _points(figures, r'(?P<x>\d+) events/s, (?P<series>.*), lost')
    rates = sorted({x for points in series.values() for x in points})
    if len(rates) < 2:
        return ''
    chart = Chart('Lost events', 'lost (%)', 'events a second', [f'{rate:,}' for rate in rates], 0, 100)
    for index, points in enumerate(series.values()):
        chart.line([points.get(rate) for rate in rates], index, [_about(rate, points[rate]) for rate in rates if rate in points],
                   (index - 1) * 0.05)
    return legend(list(series)) + f'<div class="pictures"><figure>{chart.svg()}</figure></div>'


def processes(figures):
    """The time until all run, and until all have ended, by their number, beside a bare loop."""
    series = _points(figures, r'(?P<x>\d+) process(?:es)? (?P<series>started|stopped)')
    counts = sorted({x for points in series.values() for x in points})
    if len(counts) < 2:
        return ''
    pictures = []
    for what, title in (('started', 'Until all run'), ('stopped', 'From SIGINT until all have ended')):
        launched = [series.get(what, {}).get(count) for count in counts]
        known = [(count, one) for count, one in zip(counts, launched) if one]
        low = min(min(one['floor'], max(one['low'], one['floor'] / 10)) for _, one in known)
        chart = Chart(title, 'ms', 'processes', [f'{count:,}' for count in counts], low, max(one['high'] for _, one in known), True)
        chart.line(launched, 0, [_about(count, one) for count, one in known])
        floors = [one and {'value': one['floor'], 'low': one.get('floor_low', one['floor']),
                           'high': one.get('floor_high', one['floor'])} for one in launched]
        chart.line(floors, 1, [f"{count:,}: {number(one['floor'])} ms, {one['floor_name']}" for count, one in known])
        pictures.append(f'<figure>{chart.svg()}</figure>')
    return legend(['launch', 'a bare loop']) + f'<div class="pictures">{"".join(pictures)}</div>'


def entities(figures):
    """The time of a message within a process, by the number of idle subscriptions; a line for each rclcpp."""
    series = _points(figures, r'(?P<series>.*?)(?:: )?a message beside (?P<x>\d+) subscriptions?')
    counts = sorted({x for points in series.values() for x in points})
    if len(counts) < 2:
        return ''
    chart = Chart('A message within a process', 'µs', 'idle subscriptions', [f'{count:,}' for count in counts], 0,
                  max(one['high'] for points in series.values() for one in points.values()))
    for index, points in enumerate(series.values()):
        chart.line([points.get(count) for count in counts], index,
                   [_about(count, points[count]) for count in counts if count in points], (index - 0.5) * 0.05)
    return legend([name or 'this stack' for name in series]) + f'<div class="pictures"><figure>{chart.svg()}</figure></div>'


# By the group of the figures.
PICTURES = {'losses': losses, 'start and stop of processes': processes, 'executors with idle entities': entities}
