# SPDX-License-Identifier: Apache-2.0
"""The figures of benchmarks that are kept over time."""

import json
import os
import tempfile
import unittest
from pathlib import Path

from evaluation import figures

SOURCE = Path(os.environ['SOURCE_DIRECTORY'])


def sample(name, values, floor=()):
    return json.dumps({'name': name, 'unit': 'ms', 'values': values, 'floor_name': 'bare' if floor else '', 'floor': list(floor),
                       'better': 'lower'})


def record(date, *lines):
    return figures.record_of(list(figures.figures_of_lines('start', lines)), 'a' * 40, date)


class Figures(unittest.TestCase):

    def test_the_newest_of_each_figure_counts(self):
        records = [record('2026-01-01', sample('a', [1.0] * 5), sample('b', [2.0] * 5)), record('2026-01-02', sample('a', [3.0] * 5))]
        newest = figures.newest(records)
        self.assertEqual({one['name']: one['value'] for one in newest['figures']}, {'a': 3.0, 'b': 2.0})
        self.assertEqual(newest['date'], '2026-01-02')
        self.assertIsNone(figures.newest([]))

    def test_the_page_shows_them_with_their_floor_and_where_they_come_from(self):
        text = figures.page(f'before\n{figures.BEGIN}\nold\n{figures.END}\nafter\n', [record('2026-01-01', sample('a', [6.0] * 5, [3.0] * 5))])
        self.assertEqual(text, f'''before
{figures.BEGIN}
| what | median | floor | ratio | command | measured |
| --- | --- | --- | --- | --- | --- |
| a | 6 ms | 3 (bare) | 2 | `./dev bench start` | 2026-01-01, aaaaaaaa |
{figures.END}
after
''')

    def test_a_benchmark_is_run_recorded_and_compared(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = Path(folder)
            program = folder / 'bench_start'
            program.write_text(f"#!/bin/sh\necho '{sample('a', [6.0] * 5)}' >> $BENCHMARK_SAMPLES\n")
            program.chmod(0o755)
            page = folder / 'page.md'
            page.write_text(f'{figures.BEGIN}\n{figures.END}\n')
            paths = ['--figures', str(folder / 'figures.jsonl'), '--page', str(page), str(program)]
            self.assertEqual(figures.main(['compare', *paths]), 1, 'there is nothing to compare with')
            self.assertEqual(figures.main(['record', *paths]), 0)
            self.assertEqual(len(figures.read(folder / 'figures.jsonl')), 1)
            self.assertIn('| a | 6 ms |', page.read_text())
            self.assertEqual(figures.main(['compare', *paths]), 0)

    def test_the_page_of_the_repository_is_drawn_from_its_figures(self):
        text = (SOURCE / 'docs/performance.md').read_text()
        self.assertEqual(text, figures.page(text, figures.read(SOURCE / 'docs/figures.jsonl')))


if __name__ == '__main__':
    unittest.main()
