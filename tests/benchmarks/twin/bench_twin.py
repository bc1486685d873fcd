# SPDX-License-Identifier: Apache-2.0
"""
How near twins are: systems are recorded, simulated as they were, run as twins, and recorded once more, in turns. Each figure is
the median of all rounds, so what else the machine does counts little. Prints the table of docs/twin.md.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

LAUNCH = os.environ['LAUNCH_PROGRAM']
EXAMPLES = Path(os.environ['SOURCE_DIRECTORY']) / 'launch_examples'
SHORT_NS = 10_000  # of a callback

# A launch file with its arguments, and the bytes of messages, which a trace does not tell and whoever has the system knows.
SYSTEMS = {
    'two processes, 01_ping_pong': (('01_ping_pong.launch.xml', 'count:=0', 'period_ms:=50'), 64),
    '24 nodes on the threads of one executor': (('threads.launch.xml',), 4096),
    '24 processes, 12_reference_system': (('12_reference_system.launch.xml', 'messages:=0'), 4096),
}
THREADS = '''<launch>
  <trace session-name="threads" append-timestamp="true" subbuffer-size-ust="1048576"/>
  <node pkg="autoware_reference_system" exec="autoware_default_multithreaded" args="--number-crunch-limit 4096"/>
</launch>'''


def launch(*words):
    run = subprocess.run([LAUNCH, *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if run.returncode != 0:
        raise SystemExit(f'bench_twin: error: launch {words} failed:\n{run.stdout}{run.stderr}')
    return run.stdout


class System:

    def __init__(self, directory, words, seconds, size):
        file = EXAMPLES / words[0]
        if not file.exists():
            file = directory / words[0]
            file.write_text(THREADS)
        self.file = directory / f'for_a_while_{words[0]}'
        self.file.write_text(f'<launch><include file="{file}">' +
                             ''.join('<arg name="{}" value="{}"/>'.format(*word.split(':=')) for word in words[1:]) +
                             f'</include><timer period="{seconds}"><shutdown/></timer></launch>')
        self.directory = directory
        self.size = size
        self.runs = {'recorded': [], 'simulated': [], 'run': [], 'recorded again': []}

    def record(self):
        traces = self.directory / 'traces'
        before = set(traces.iterdir()) if traces.exists() else set()
        launch('--isolate', self.file)
        (trace,) = set(traces.iterdir()) - before
        return trace

    def round(self):
        trace = self.record()
        figures = json.loads(launch('twin', trace, '-o', self.directory / 'twin', '--run', '--json', '--bytes', self.size))['figures']
        again = json.loads(launch('twin', self.record(), '--json'))['figures']
        for column in ('recorded', 'simulated', 'run'):
            self.runs[column].append({(one['kind'], one['name']): one[column] for one in figures if column in one})
        self.runs['recorded again'].append({(one['kind'], one['name']): one['recorded'] for one in again})

    def figure(self, column, row, part):
        """The median of the rounds."""
        values = [run[row][part] for run in self.runs[column] if row in run and run[row]['count'] >= 5]
        return statistics.median(values) if values else None

    def cell(self, column, rows):
        """The median of the errors of all medians, how many of them are within 10 %, and how many p99 within 25 %."""
        errors = {part: [] for part in ('p50_ns', 'p99_ns')}
        for row in rows:
            for part, list_of in errors.items():
                recorded, value = self.figure('recorded', row, part), self.figure(column, row, part)
                if recorded and value is not None:
                    list_of.append(abs(value - recorded) / recorded)
        if not errors['p50_ns']:
            return '-'
        return (f'{100 * statistics.median(errors["p50_ns"]):.1f} %, {sum(one <= 0.1 for one in errors["p50_ns"])}, '
                f'{sum(one <= 0.25 for one in errors["p99_ns"])}')

    def rows(self):
        rows = [row for row in self.runs['recorded'][0] if self.figure('recorded', row, 'p50_ns') is not None]
        callbacks = [row for row in rows if row[0] == 'callback']
        longer = [row for row in callbacks if self.figure('recorded', row, 'p50_ns') >= SHORT_NS]
        yield f'{len(callbacks)} callbacks', callbacks
        if 0 < len(longer) < len(callbacks):
            yield f'{len(longer)} of them of 10 us or more', longer
        ways = [row for row in rows if row[0] == 'hop']
        yield f'{len(ways)} ways', ways

    def details(self):
        for row in sorted(self.runs['recorded'][0]):
            figures = [self.figure(column, row, part) for column in self.runs for part in ('p50_ns', 'p99_ns')]
            print(f'{row[1][:60]:<60}', *(f'{figure / 1000:9.1f}' if figure is not None else f'{"-":>9}' for figure in figures),
                  file=sys.stderr)


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument('--rounds', type=int, default=3)
    arguments.add_argument('--seconds', type=float, default=10, help='that each system runs')
    arguments.add_argument('--system', type=int, choices=(1, 2, 3), help='only the first, second or third')
    arguments.add_argument('--details', action='store_true', help='also each figure, in us')
    options = arguments.parse_args()
    print(f'{os.cpu_count()} processors, load {os.getloadavg()[0]:.1f}; {options.rounds} rounds of {options.seconds:.0f} s\n')
    print('| system | rows | simulated | twin, run | recorded again |\n| --- | --- | --- | --- | --- |')
    for number, (name, (words, size)) in enumerate(SYSTEMS.items(), 1):
        if options.system not in (None, number):
            continue
        with tempfile.TemporaryDirectory(prefix='bench_twin-') as directory:
            os.environ.update(ROS_HOME=directory, ROS_TRACE_DIR=f'{directory}/traces')
            system = System(Path(directory), words, options.seconds, size)
            for _ in range(options.rounds):
                system.round()
            for title, rows in system.rows():
                print(f'| {name} | {title} |', ' | '.join(system.cell(column, rows) for column in
                                                          ('simulated', 'run', 'recorded again')), '|', flush=True)
                name = ''
            if options.details:
                system.details()
    print(f'\nload at the end {os.getloadavg()[0]:.1f}')


if __name__ == '__main__':
    main()
