# SPDX-License-Identifier: Apache-2.0
"""Reads package.xml: the name of a package, how it is built, and which packages it needs."""

import os
import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Dict, List, Mapping, Optional
from xml.parsers import expat

# The tags that name a package which must be built before.
BEFORE = ('depend', 'build_depend', 'buildtool_depend', 'build_export_depend', 'buildtool_export_depend', 'exec_depend',
          'run_depend', 'group_depend')
BUILD_TYPES = ('ament_cmake', 'ament_python', 'cmake')


class PackageError(Exception):
    """What is wrong with a package.xml, or with the packages of a workspace together."""


@dataclass
class Package:
    name: str
    folder: Path
    build_type: str = 'ament_cmake'
    depends: List[str] = field(default_factory=list)  # must be built before
    test_depends: List[str] = field(default_factory=list)  # are built before, too, if that makes no circle
    groups: List[str] = field(default_factory=list)  # that it is a member of
    group_depends: List[str] = field(default_factory=list)  # all members of these groups must be built before


def read_package(folder: Path, environment: Mapping[str, str]) -> Package:
    """Reads the package.xml of a folder. Conditions see `environment`."""
    path = folder / 'package.xml'
    return _Reader(path, path.read_bytes(), environment).read()


class _Reader:
    def __init__(self, path: Path, data: bytes, environment: Mapping[str, str]):
        self._path, self._data = path, data
        self._environment = {'ROS_VERSION': '2', **environment}
        self._open: List[str] = []
        self._text = ''
        self._attributes: Dict[str, str] = {}
        self._line = 1
        self._found: Dict[str, List[str]] = {}

    def read(self) -> Package:
        parser = expat.ParserCreate()
        parser.StartElementHandler = lambda tag, attributes: self._start(tag, attributes, parser.CurrentLineNumber)
        parser.EndElementHandler = lambda tag: self._end(tag)
        parser.CharacterDataHandler = self._characters
        try:
            parser.Parse(self._data, True)
        except expat.ExpatError as error:
            raise self._error(error.lineno, expat.errors.messages[error.code]) from None
        names = self._found.get('name', [])
        if not names or not re.fullmatch(r'[A-Za-z][\w-]*', names[0]):
            raise self._error(1, 'the package has no <name>' if not names else f"'{names[0]}' is no name of a package")
        package = Package(names[0], self._path.parent)
        package.build_type = (self._found.get('build_type') or [self._usual_build_type()])[-1]
        package.depends = list(dict.fromkeys(name for tag in BEFORE if tag != 'group_depend'
                                             for name in self._found.get(tag, [])))
        package.test_depends = self._found.get('test_depend', [])
        package.groups = self._found.get('member_of_group', [])
        package.group_depends = self._found.get('group_depend', [])
        return package

    def _usual_build_type(self) -> str:
        return 'catkin' if 'catkin' in self._found.get('buildtool_depend', []) else 'ament_cmake'

    def _start(self, tag: str, attributes: Dict[str, str], line: int) -> None:
        if not self._open and tag != 'package':
            raise self._error(line, f'the first element must be <package> and not <{tag}>')
        self._open.append(tag)
        self._text, self._attributes, self._line = '', attributes, line

    def _characters(self, text: str) -> None:
        self._text += text

    def _end(self, tag: str) -> None:
        self._open.pop()
        text = self._text.strip()
        self._text = ''
        direct = len(self._open) == 1 and tag in (*BEFORE, 'name', 'test_depend', 'member_of_group')
        if not direct and (self._open[-1:] != ['export'] or tag != 'build_type'):
            return
        condition = self._attributes.get('condition')
        if condition is None or self._holds(condition):
            self._found.setdefault(tag, []).append(text)

    def _holds(self, condition: str) -> bool:
        """Comparisons of words and $VARIABLES, joined by `and` and `or`, with brackets."""
        tokens = re.findall(r'"[^"]*"|\'[^\']*\'|[()]|[<>=!]=|[<>]|[^\s()<>=!]+|\S', condition)
        expression = []
        for token in tokens:
            if token in ('and', 'or', '(', ')', '==', '!=', '<=', '>=', '<', '>'):
                expression.append(token)
            else:
                word = token[1:-1] if token[0] in '"\'' else token
                expression.append(repr(self._environment.get(word[1:], '') if word.startswith('$') else word))
        try:
            return bool(eval(' '.join(expression), {'__builtins__': {}}))  # only literals, comparisons, and, or
        except (SyntaxError, TypeError):
            raise self._error(self._line, f"'{condition}' is no condition") from None

    def _error(self, line: int, what: str) -> PackageError:
        lines = self._data.decode(errors='replace').splitlines()
        text = lines[line - 1].strip() if 0 < line <= len(lines) else ''
        return PackageError(f'{os.path.relpath(self._path)}:{line}: error: {what}\n  {text}' if text
                            else f'{os.path.relpath(self._path)}: error: {what}')
