# SPDX-License-Identifier: Apache-2.0
"""The JSON of an evaluation: written, read, refused."""

import json
import tempfile
import unittest
from pathlib import Path

from evaluation import results
from evaluation.bootstrap import Estimate
from evaluation.results import Figure, ResultError


class Reading(unittest.TestCase):

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = Path(self.folder.name) / 'evaluation.json'

    def message_of(self, text):
        self.path.write_text(text)
        with self.assertRaises(ResultError) as caught:
            results.read(self.path)
        return str(caught.exception).replace(str(self.path), 'FILE')

    def test_gives_what_was_written(self):
        results.write({'figures': [Figure('start', 'one process', 'ms', 2.0, 1.5, 2.5, 7).as_json()]}, self.path)
        figures = results.figures_of(results.read(self.path))
        self.assertEqual(list(figures), ['start: one process'])
        self.assertEqual(figures['start: one process'].high, 2.5)

    def test_gives_a_ratio_the_spread_of_both_sides(self):
        figure = results.figure_of('start', 'a', 'ms', Estimate(20.0, 14.0, 26.0), 7, floor=Estimate(10.0, 6.0, 14.0))
        self.assertEqual(figure.ratio.as_json(), {'value': 2.0, 'low': 1.0, 'high': 3.0})
        self.assertIsNone(results.figure_of('start', 'a', 'ms', Estimate(20.0, 14.0, 26.0), 7).ratio)

    def test_refuses_what_is_no_json(self):
        self.assertEqual(self.message_of('{'), 'FILE: no JSON: Expecting property name enclosed in double quotes: '
                         'line 1 column 2 (char 1)')

    def test_refuses_json_of_something_else(self):
        self.assertEqual(self.message_of('[]'), 'FILE: this is no result of ./dev evaluate')

    def test_refuses_another_version(self):
        self.assertEqual(self.message_of(json.dumps({'format': 'launch-evaluation', 'version': 7})),
                         'FILE: version 7 of the format, this program reads version 1')

    def test_refuses_a_file_that_is_not_there(self):
        with self.assertRaises(ResultError) as caught:
            results.read(self.path)
        self.assertEqual(str(caught.exception), f'{self.path}: No such file or directory')


if __name__ == '__main__':
    unittest.main()
