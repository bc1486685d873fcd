# SPDX-License-Identifier: Apache-2.0
"""
The includes of the sources: which file includes which, and which room which. Nothing is compiled.

A room is a folder whose files belong together. docs/architecture.md names the rooms and what each may use.
"""

import re
from pathlib import Path

SUFFIXES = ('.hpp', '.cpp', '.h', '.c')
INCLUDE = re.compile(r'^[ \t]*#\s*include\s*["<]([^">]+)[">]', re.MULTILINE)
# Headers are found below these folders of a package, as the compiler finds them.
HEADER_FOLDERS = ('include', 'src')


def source_files(top, folders):
    """Returns the C and C++ files below the folders, as paths from the top."""
    return [path.relative_to(top) for folder in folders for path in sorted((top / folder).rglob('*')) if path.suffix in SUFFIXES]


class IncludeGraph:
    """Finds the file behind each include. An include of a file outside the given ones is left out."""

    def __init__(self, top, folders):
        self.top = top
        self.files = source_files(top, folders)
        self._known = set(self.files)
        self._below_include = {}  # name in an include → file, for what packages offer
        for file in self.files:
            if 'include' in file.parts:
                self._below_include.setdefault(Path(*file.parts[file.parts.index('include') + 1:]), file)

    def includes(self, file):
        """Yields the line number and the included file, for each include of `file`."""
        text = (self.top / file).read_text(encoding='utf-8')
        package_source = next((Path(*file.parts[:i + 1]) for i, part in enumerate(file.parts) if part == 'src'), None)
        for match in INCLUDE.finditer(text):
            name = Path(match.group(1))
            beside = file.parent / name
            candidates = [name, beside] + ([package_source / name] if package_source else [])
            found = next((c for c in candidates if c in self._known), None) or self._below_include.get(name)
            if found and found != file:
                yield text.count('\n', 0, match.start()) + 1, found


def read_arrows(text):
    """
    Reads the table of arrows: a dictionary from each room to the rooms that it may use, in the order of the table.

    A row is `room: room room …`; a row that begins with a blank goes on with the row above it. `#` begins a comment.
    """
    arrows = {}
    for number, line in enumerate(text.splitlines(), 1):
        line = line.split('#')[0].rstrip()
        if not line:
            continue
        if line[0].isspace():
            arrows[room] += line.split()
            continue
        room, colon, targets = line.partition(':')
        if not colon or room in arrows:
            raise ValueError(f'line {number}: {"no colon" if not colon else "the room stands here a second time"}: {line}')
        arrows[room] = targets.split()
    return arrows


def room_of(file, rooms):
    """Returns the room of a file: the one with the longest path above it, or None."""
    above = (str(parent) for parent in Path(file).parents)
    return next((parent for parent in above if parent in rooms), None)
