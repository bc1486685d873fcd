# SPDX-License-Identifier: Apache-2.0
"""
The arrows between rooms: docs/architecture.md has the table of what each room may use, in a block `arrows`.

The includes of the sources and the links of CMake (PUBLIC and PRIVATE) are held against it, and it against them: a row
names no room that its room does not use. Each room uses rooms above it in the table only, so there is no circle.
"""

import os
import re
import tempfile
import unittest
from pathlib import Path

from include_graph import IncludeGraph, read_arrows, room_of

SOURCE = Path(os.environ['SOURCE_DIRECTORY'])
BUILD = Path(os.environ['BUILD_DIRECTORY'])
FOLDERS = ('base', 'launcher', 'actions', 'tracing', 'programs', 'instrumented_stack')
MOST_FILES = 40
# Folders whose files have the names that others gave them: public headers and interfaces of ROS 2, its Python packages.
NAMED_BY_OTHERS = ('include', 'msg', 'srv', 'action', 'packages')


def table():
    text = (SOURCE / 'docs/architecture.md').read_text(encoding='utf-8')
    return read_arrows(re.search(r'^```arrows\n(.*?)^```$', text, re.MULTILINE | re.DOTALL).group(1))


def upward_arrows(arrows):
    """Arrows to a room that does not stand above in the table: to an unknown one, or against the order."""
    rows = list(arrows)
    return [f'{room}: {target} does not stand above it in the table'
            for i, room in enumerate(rows) for target in arrows[room] if target not in rows[:i]]


def include_errors(top, arrows, folders=FOLDERS):
    """Returns the includes against the arrows, and the arrows (room, room) that includes use."""
    errors, used = [], set()
    graph = IncludeGraph(top, folders)
    for file in graph.files:
        room = room_of(file, arrows)
        if room is None:
            errors.append(f'{file}: no room of the table holds this file')
            continue
        for line, included in graph.includes(file):
            target = room_of(included, arrows)
            if target == room:
                continue
            used.add((room, target))
            if target not in arrows[room]:
                errors.append(f'{file}:{line}: includes {included}, but {room} may not use {target}')
    return errors, used


def link_errors(lines, arrows, folders=FOLDERS):
    """The same for the links of CMake: lines `folder <tab> target <tab> what it links`."""
    errors, used = [], set()
    rows = [line.split('\t') for line in lines]
    folder_of = {target: folder for folder, target, _ in rows}
    for folder, name, links in rows:
        room = room_of(f'{folder}/CMakeLists.txt', arrows)
        if folder.split('/')[0] not in folders or room is None:
            continue
        for link in links.split():
            linked = folder_of.get(link.split('::')[-1])
            target = linked is not None and room_of(f'{linked}/CMakeLists.txt', arrows)
            if not target or target == room:
                continue
            used.add((room, target))
            if target not in arrows[room]:
                errors.append(f'{folder}/CMakeLists.txt: {name} links {link}, but {room} may not use {target}')
    return errors, used


def crowded_rooms(top, folders=FOLDERS):
    """Folders with more files than a reader keeps in mind."""
    result = []
    for folder in folders:
        for path in [top / folder, *sorted(p for p in (top / folder).rglob('*') if p.is_dir())]:
            files = sum(1 for file in path.iterdir() if file.is_file() and file.suffix != '.pyc')
            name = path.relative_to(top)
            if files > MOST_FILES and not set(NAMED_BY_OTHERS) & set(name.parts):
                result.append(f'{name}: {files} files, more than {MOST_FILES}')
    return result


class Arrows(unittest.TestCase):
    maxDiff = None

    def test_each_room_uses_rooms_above_it_only(self):
        self.assertEqual(upward_arrows(table()), [])

    def test_includes_and_links_follow_the_arrows_and_need_them_all(self):
        arrows = table()
        errors, used = include_errors(SOURCE, arrows)
        self.assertGreater(len(used), 150, 'the includes are found')
        links, linked = link_errors((BUILD / 'link_graph.tsv').read_text().splitlines(), arrows)
        self.assertGreater(len(linked), 100, 'the links are found')
        self.assertEqual(errors + links, [])
        if os.environ.get('HAS_ALL_PARTS') == '0':
            self.skipTest('a build without all parts does not have all links')
        unused = [f'{room}: nothing in it uses {target}' for room, targets in arrows.items() for target in targets
                  if (room, target) not in used | linked]
        self.assertEqual(unused, [])

    def test_no_room_is_crowded(self):
        self.assertEqual(crowded_rooms(SOURCE), [])


class PlantedFaults(unittest.TestCase):
    """Each kind of fault, planted in a small tree, is found at its place."""

    ARROWS = 'below:\nabove: below  # a comment\n'

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.top = Path(folder.name)
        self.write('below/stone.hpp', '#pragma once\n')
        self.write('above/roof.cpp', '#include <vector>\n#include "below/stone.hpp"\n')

    def write(self, name, text):
        (self.top / name).parent.mkdir(parents=True, exist_ok=True)
        (self.top / name).write_text(text)

    def errors(self, arrows=ARROWS):
        return include_errors(self.top, read_arrows(arrows), ('below', 'above'))[0]

    def test_a_sound_tree_has_none(self):
        self.assertEqual(self.errors(), [])
        self.assertEqual(link_errors(['below\tstone\tfmt::fmt', 'above\troof\tstone'], read_arrows(self.ARROWS), ('below', 'above')),
                         ([], {('above', 'below')}))

    def test_a_forbidden_include(self):
        self.write('above/roof.hpp', '#pragma once\n')
        self.write('below/stone.cpp', '#include "below/stone.hpp"\n\n#include "above/roof.hpp"\n')
        self.assertEqual(self.errors(), ['below/stone.cpp:3: includes above/roof.hpp, but below may not use above'])

    def test_a_forbidden_private_link(self):
        lines = ['below\tstone\tproject_options roof', 'above\troof\tstone']
        self.assertEqual(link_errors(lines, read_arrows(self.ARROWS), ('below', 'above'))[0],
                         ['below/CMakeLists.txt: stone links roof, but below may not use above'])

    def test_a_circle(self):
        self.assertEqual(upward_arrows(read_arrows('below: above\nabove: below\n')),
                         ['below: above does not stand above it in the table'])

    def test_a_file_outside_all_rooms(self):
        self.assertEqual(self.errors('below:\n'), ['above/roof.cpp: no room of the table holds this file'])

    def test_a_room_with_41_files(self):
        for i in range(40):
            self.write(f'below/stone{i}.hpp', '')
        self.write('below/include/free/a.hpp', '')
        self.assertEqual(crowded_rooms(self.top, ('below', 'above')), ['below: 41 files, more than 40'])


if __name__ == '__main__':
    unittest.main()
