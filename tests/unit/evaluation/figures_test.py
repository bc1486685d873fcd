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

    def test_what_was_measured_by_hand_is_shown_with_its_range_and_not_compared(self):
        figure = {'group': 'start', 'name': 'b', 'unit': 's', 'value': 3, 'low': 2, 'high': 4, 'samples': 1}
        by_hand = {'date': '2025-12-31', 'commit': '', 'preset': figures.BY_HAND, 'command': 'launch FILE', 'machine': {}, 'warnings': [],
                   'figures': [figure, {**figure, 'name': 'c', 'note': figures.RANGE, 'floor': 1.5, 'floor_low': 1, 'floor_high': 2, 'floor_name': 'bare'},
                               {**figure, 'name': 'a', 'low': 3, 'high': 3}]}
        self.assertEqual(figures.table([by_hand, record('2026-01-01', sample('a', [6.0] * 5))]).splitlines()[2:],
                         ['| b | 3 (2 to 4) s |  |  | `launch FILE` | 2025-12-31 |',
                          '| c | 2 to 4 s | 1 to 2 (bare) | 2 | `launch FILE` | 2025-12-31 |',
                          '| a | 6 ms |  |  | `./dev bench start` | 2026-01-01, aaaaaaaa |'])
        with tempfile.TemporaryDirectory() as folder:
            kept = Path(folder) / 'figures.jsonl'
            kept.write_text(json.dumps(by_hand) + '\n')
            self.assertEqual(figures.main(['compare', '--figures', str(kept)]), 1, 'there is nothing to compare with')

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
