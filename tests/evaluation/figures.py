# SPDX-License-Identifier: Apache-2.0
"""
The figures of `./dev bench`, kept over time: record, compare, page.

docs/figures.jsonl has a line for each recorded run of the benchmarks, in the order of time: when, of which commit, on which machine, and every
figure with its interval and its floor. docs/performance.md shows the newest of each. `compare` measures again and says what has
changed beyond noise; it never fails for that, since a machine may be busy.

A record of the preset BY_HAND holds figures that no benchmark reports, or did not report when they were measured: it names their
command, and an interval is what was seen, not a confidence. They are shown, and nothing is compared with them.
"""

import argparse
import datetime
import json
import subprocess
import sys
import tempfile
from pathlib import Path

from . import machine
from .bootstrap import of_samples
from .compare import compare
from .drawing import number
from .measures.benchmark import BenchmarkError, run
from .results import Figure, figure_of

BY_HAND = 'by hand'
RANGE = 'only the range is known'  # a note of a figure: its value is just the middle of it
BEGIN, END = '<!-- figures: begin -->', '<!-- figures: end -->'


def figures_of_lines(bench, lines):
    """The figures of what a benchmark has reported (tests/benchmarks/samples), a line of JSON each."""
    for line in lines:
        one = json.loads(line)
        floor = {}
        if one['floor']:
            floor = {'floor': of_samples(one['floor']), 'floor_name': one['floor_name']}
        yield figure_of(bench, one['name'], one['unit'], of_samples(one['values']), len(one['values']), better=one['better'], **floor)


def measure(programs):
    """Runs the benchmarks; returns the figures of those that report some."""
    figures = []
    for program in programs:
        with tempfile.NamedTemporaryFile() as samples:
            print(run([program], {'BENCHMARK_SAMPLES': samples.name}), end='', flush=True)
            figures += figures_of_lines(program.name.removeprefix('bench_'), Path(samples.name).read_text().splitlines())
    return figures


def record_of(figures, commit, date):
    return {'date': date, 'commit': commit, 'preset': 'bench', 'machine': machine.description(), 'warnings': [],
            'figures': [figure.as_json() for figure in figures]}


def read(path):
    return [json.loads(line) for line in path.read_text().splitlines()] if path.exists() else []


def newest(records):
    """One record with the newest of each figure; its date and machine are those of the newest record."""
    if not records:
        return None
    figures = {}
    for record in records:
        for figure in record['figures']:
            figures[figure['group'], figure['name']] = figure
    return {**records[-1], 'figures': list(figures.values())}


def shown(value, low, high, seen, has_value):
    """A number of a figure, with the range if it is one that was seen."""
    if not seen or low is None or low == high:
        return number(value)
    seen = f'{number(low)} to {number(high)}'
    return f'{number(value)} ({seen})' if has_value else seen


def row(record, figure):
    by_hand = record['preset'] == BY_HAND
    value = shown(figure.value, figure.low, figure.high, by_hand, figure.note != RANGE)
    floor = f'{shown(figure.floor, figure.floor_low, figure.floor_high, by_hand, False)} ({figure.floor_name})' if figure.floor else ''
    ratio = number(figure.ratio.value) if figure.ratio else ''
    command = record.get('command', f'./dev bench {figure.group}')
    command = f'`{command}`' if command else ''
    measured = ', '.join(filter(None, (record['date'], record['commit'][:8])))
    return f'| {figure.name} | {value} {figure.unit} | {floor} | {ratio} | {command} | {measured} |'


def table(records):
    """The newest of each figure as a table of Markdown, by subject."""
    rows = {}
    for record in records:
        for one in record['figures']:
            figure = Figure(**one)
            rows[figure.group, figure.name] = row(record, figure)
    subjects = dict.fromkeys(group for group, _ in rows)
    lines = ['| what | median | floor | ratio | command | measured |', '| --- | --- | --- | --- | --- | --- |']
    for subject in sorted(subjects):
        lines += [text for (group, _), text in rows.items() if group == subject]
    return '\n'.join(lines)


def page(text, records):
    """docs/performance.md with the table of the newest figures in its place."""
    before, after = text.index(BEGIN) + len(BEGIN), text.index(END)
    return f'{text[:before]}\n{table(records)}\n{text[after:]}'


def commit_of_sources():
    try:
        described = subprocess.run(['git', 'describe', '--always', '--dirty', '--abbrev=40', '--exclude=*'], capture_output=True, text=True)
    except FileNotFoundError:  # a machine without git
        return 'unknown'
    return described.stdout.strip() or 'unknown'


def main(arguments):
    parser = argparse.ArgumentParser(prog='./dev bench', description=__doc__.strip().splitlines()[0])
    parser.add_argument('what', choices=('record', 'compare', 'page'))
    parser.add_argument('--figures', type=Path, default=Path('docs/figures.jsonl'))
    parser.add_argument('--page', type=Path, default=Path('docs/performance.md'))
    parser.add_argument('programs', nargs='*', type=Path)
    options = parser.parse_intermixed_args(arguments)
    records = read(options.figures)
    if options.what == 'page':
        options.page.write_text(page(options.page.read_text(), records))
        return 0
    try:
        figures = measure(options.programs)
    except BenchmarkError as error:
        print(f'dev bench: error: {error}', file=sys.stderr)
        return 1
    record = record_of(figures, commit_of_sources(), datetime.date.today().isoformat())
    if options.what == 'record':
        with options.figures.open('a') as file:
            file.write(json.dumps(record) + '\n')
        options.page.write_text(page(options.page.read_text(), [*records, record]))
        print(f'{len(figures)} figures recorded in {options.figures} and {options.page}')
        return 0
    before = newest([record for record in records if record['preset'] != BY_HAND])
    if before is None:
        print(f'dev bench: error: {options.figures} has no figures to compare with', file=sys.stderr)
        return 1
    measured = {(figure.group, figure.name) for figure in figures}
    before['figures'] = [one for one in before['figures'] if (one['group'], one['name']) in measured]
    print(f'compared with {before["commit"][:8]} of {before["date"]}')
    print(compare(before, record).text(), end='')
    return 0


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
