# SPDX-License-Identifier: Apache-2.0
"""Tables of the pages are whole, and the samples of errors in them point at the column that they name."""

import os
import re
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ['SOURCE_DIRECTORY'])
BELOW_HEAD = re.compile(r'\|[ :|-]+\|$')
CELL_END = re.compile(r'(?<!\\)\|')
PLACE = re.compile(r'\S+:\d+:(\d+): (?:error|warning): ')
CARET = re.compile(r' *\| ( *)\^~*$')


def pages(top):
    folders = ('', 'docs/', 'launch_examples/', 'instrumented_stack/*/', 'tests/*/')
    return sorted(path for folder in folders for path in top.glob(f'{folder}*.md'))


def faults(path):
    """(line, what is wrong) of a page."""
    lines = path.read_text(encoding='utf-8').splitlines()
    in_block, cells = False, 0
    for at, line in enumerate(lines):
        if line.startswith('```'):
            in_block = not in_block
        elif in_block:
            place = PLACE.match(line)
            caret = place and at + 2 < len(lines) and CARET.match(lines[at + 2])
            if caret and len(caret[1]) + 1 != int(place[1]):
                yield at + 1, f'the caret is below column {len(caret[1]) + 1}, not {place[1]}'
        elif line.startswith('|'):
            here = len(CELL_END.findall(line)) - 1
            if at and lines[at - 1].startswith('|'):
                if here != cells:
                    yield at + 1, f'{here} cells in a table of {cells}'
            elif at + 1 < len(lines) and BELOW_HEAD.match(lines[at + 1]):
                cells = here
            else:
                cells = here
                yield at + 1, 'a row without the head of its table'


class PageShapes(unittest.TestCase):
    def test_the_pages(self):
        found = [f'{path.relative_to(SOURCE)}:{line}: {what}' for path in pages(SOURCE) for line, what in faults(path)]
        self.assertEqual(found, [])

    def test_faults_are_found(self):
        with tempfile.TemporaryDirectory() as directory:
            page = Path(directory) / 'page.md'
            page.write_text('| a | b |\n| --- | --- |\n| 1 | `x \\| y` |\n| 2 |\n\n| 3 | 4 |\n\n```\n| no | table\n'
                            "a.launch.xml:1:9: error: no\n    1 | <launch a='1'>\n      |         ^~~\n"
                            "a.launch.xml:1:8: error: no\n    1 | <launch a='1'>\n      |         ^~~\n```\n", encoding='utf-8')
            self.assertEqual(list(faults(page)), [(4, '1 cells in a table of 2'), (6, 'a row without the head of its table'),
                                                  (13, 'the caret is below column 9, not 8')])


if __name__ == '__main__':
    unittest.main()
