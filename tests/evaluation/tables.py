# SPDX-License-Identifier: Apache-2.0
"""The tables of a result, as rows of text. The page and the Markdown show the same ones."""

from . import paper
from .drawing import number
from .results import Figure

NOT_MEASURED = '–'


def with_interval(estimate, factor=1, unit=''):
    """`1.2 (1.0 to 1.4)`"""
    value, low, high = (number(factor * estimate[key]) for key in ('value', 'low', 'high'))
    return f'{value} ({low} to {high}){unit}'


def where(processes):
    return 'two processes' if int(processes) == 2 else 'one process'


def beside_the_paper(experiment):
    """The aggregates beside the figures of the paper."""
    aggregates = sorted(experiment['aggregates'].items(), reverse=True)
    head = ['', 'the paper, two processes', *(f'here, {where(processes)}' for processes, _ in aggregates)]
    rows = [
        ['added to a message on average, all messages merged, µs', number(paper.MEAN_OVERHEAD_US),
         *(with_interval(one['overhead_merged']) for _, one in aggregates)],
        ['the same, each combination counting the same, µs', NOT_MEASURED,
         *(with_interval(one['overhead_of_means']) for _, one in aggregates)],
        ['added to the median, each combination counting the same, µs', NOT_MEASURED,
         *(with_interval(one['overhead_of_medians']) for _, one in aggregates)],
        ['middle half of the traced messages, less the untraced mean, µs',
         ' to '.join(number(value) for value in paper.MIDDLE_HALF_US),
         *(f"{number(one['traced']['p25'])} to {number(one['traced']['p75'])}" for _, one in aggregates)],
        ['part of the latency, by combination', ' to '.join(f'{number(100 * part)} %' for part in paper.PART_OF_LATENCY)],
        ['aim: at most half of the paper\'s mean, µs', NOT_MEASURED,
         *(_reached(one['overhead_merged'], paper.AIM_US) for _, one in aggregates)],
    ]
    for processes, _ in aggregates:
        parts = [one['overhead_of_median']['part']['value'] for one in experiment['combinations']
                 if one['processes'] == int(processes)]
        rows[4].append(f'{number(100 * min(parts))} to {number(100 * max(parts))} % of the median')
    return head, rows


def _reached(estimate, aim):
    if estimate['high'] <= aim:
        return f'reached: the whole interval is below {number(aim)}'
    if estimate['low'] > aim:
        return f'missed: the whole interval is above {number(aim)}'
    return f'open: the interval holds {number(aim)}'


def combinations(experiment, processes):
    """Each combination with its latencies and what tracing adds."""
    head = ['KiB', 'Hz', 'messages', 'untraced: mean', 'median', '99 %', 'most', 'added to the mean', 'added to the median',
            '% of the median', 'outliers: untraced, traced', 'missed']
    rows = []
    for one in experiment['combinations']:
        if one['processes'] == processes:
            before, after = one['untraced'], one['traced']
            rows.append([str(one['bytes'] // 1024), f"{one['rate']:,}", f"{before['messages']:,} + {after['messages']:,}",
                         number(before['mean']), number(before['p50']), number(before['p99']),
                         number(max(before['most'], after['most'])), with_interval(one['overhead_of_mean']['us']),
                         with_interval(one['overhead_of_median']['us']),
                         number(100 * one['overhead_of_median']['part']['value']),
                         f"{before['outliers']}, {after['outliers']}", str(one['missed'])])
    return head, rows


def figures(group):
    """Figures of a group, each beside its floor."""
    head = ['', 'measured', 'unit', 'floor', 'ratio', 'samples']
    rows = []
    for one in group:
        floor, ratio = '', ''
        if one.get('floor') is not None and one['floor_name'] != one['name']:
            spread = {'value': one['floor'], 'low': one['floor_low'], 'high': one['floor_high']} if 'floor_low' in one else None
            floor = f"{with_interval(spread) if spread else number(one['floor'])}: {one['floor_name']}"
            if one['floor']:
                ratio = with_interval(Figure(**one).ratio.as_json()) if spread else number(one['value'] / one['floor'])
        rows.append([one['name'] + (f" ({one['note']})" if one.get('note') else ''), with_interval(one), one['unit'].replace('us', 'µs'),
                     floor, ratio, str(one['samples'])])
    return head, rows


def groups(result):
    """The figures of a result by their group, in the order in which they were measured."""
    by_name = {}
    for one in result['figures']:
        by_name.setdefault(one['group'], []).append(one)
    return by_name


def machine(result):
    """The machine and what was set on it."""
    one = result['machine']
    rows = [['processor', f"{one['processor']}, {one['processors']} processors, {one['mhz']:.0f} MHz, cache {one['cache']}"
             + (', a virtual machine' if one['virtual'] else '')],
            ['memory', f"{one['memory_mib']:,} MiB"],
            ['kernel', f"{one['kernel']} ({one['kernel_version']}), clock {one['clock_source']}"],
            ['load before, after', f"{one['load_before'][0]}, {one['load_after'][0]}"],
            ['taken by the host', f"{number(100 * one['stolen'])} %"]]
    if 'build' in one:
        rows.append(['programs', one['build']])
    rows += [[setting['name'], f"{setting['state']}: {setting['detail']}"] for setting in result['settings']]
    return ['', ''], rows
