# SPDX-License-Identifier: Apache-2.0
"""
No files include one another in a circle, and no folders within a library. A header and the source of the same name count as one file.
Nor do Python modules import one another in a circle.

Within a library the compiler accepts such a circle as long as one of the includes stands in a source. It makes every file of
the circle depend on all others: none can be read, tested or moved alone.
"""

import ast
import os
import re
import unittest
from pathlib import Path

from include_graph import read_arrows, room_of

SOURCE = Path(os.environ['SOURCE_DIRECTORY'])
FOLDERS = ('base', 'launcher', 'actions', 'tracing', 'programs')
ARROWS = re.compile(r'^```arrows\n(.*?)^```$', re.MULTILINE | re.DOTALL)
SUFFIXES = ('.hpp', '.cpp', '.h', '.c')
STACK_INCLUDE = re.compile(r'^\s*#\s*include\s*["<]([^">]+)[">]', re.MULTILINE)
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)


def include_graph():
    """Maps each file, by its path without suffix, to the files that it includes."""
    graph = {}
    for folder in FOLDERS:
        for path in sorted((SOURCE / folder).rglob('*')):
            if path.suffix not in SUFFIXES:
                continue
            includes = graph.setdefault(path.relative_to(SOURCE).with_suffix(''), set())
            for name in INCLUDE.findall(path.read_text(encoding='utf-8')):
                for target in (SOURCE / name, path.parent / name):
                    if target.is_file():
                        includes.add(target.relative_to(SOURCE).with_suffix(''))
                        break
    for file, includes in graph.items():
        includes.discard(file)
    return graph


def stack_include_graph():
    """
    Maps each file of the instrumented stack to the files of its package that it includes.

    Public headers have the paths that ROS 2 has for them, which no source shares: a public header and its source are two files.
    The end of a header may stand in a header of its own, whose name ends in _impl.
    """
    graph = {}
    for package in sorted((SOURCE / 'instrumented_stack').iterdir()):
        for path in sorted(package.rglob('*')):
            if path.suffix not in SUFFIXES or not {'src', 'include'} & set(path.relative_to(package).parts[:1]):
                continue
            includes = graph.setdefault(stack_file(path), set())
            for name in STACK_INCLUDE.findall(path.read_text(encoding='utf-8')):
                for target in (package / 'src' / name, package / 'include' / name, path.parent / name):
                    if target.is_file():
                        includes.add(stack_file(target))
                        break
    for file, includes in graph.items():
        includes.discard(file)
    return graph


def import_graph():
    """
    Maps each Python module of the launcher to those that it imports when it is imported itself.

    Imports within functions are not counted: actions, events and handlers make one another, as they do in ROS 2.
    """
    packages = SOURCE / 'launcher' / 'python' / 'packages'
    modules = {}
    for path in sorted(packages.rglob('*.py')):
        parts = path.relative_to(packages).with_suffix('').parts
        modules['.'.join(parts[:-1] if parts[-1] == '__init__' else parts)] = path
    graph = {}
    for module, path in modules.items():
        imports = graph.setdefault(module, set())
        for statement in ast.parse(path.read_text(encoding='utf-8')).body:
            if isinstance(statement, ast.Import):
                imports.update(name.name for name in statement.names)
            elif isinstance(statement, ast.ImportFrom):
                for name in statement.names:
                    full = f'{statement.module}.{name.name}'
                    imports.add(full if full in modules else statement.module)
        own_packages = {module.rsplit('.', n)[0] for n in range(1, module.count('.') + 1)}  # Python imports these first anyway
        imports &= modules.keys() - {module} - own_packages
    return graph


def stack_file(path):
    path = path.relative_to(SOURCE / 'instrumented_stack').with_suffix('')
    return path.with_name(path.name.removesuffix('_impl'))


def folders(graph):
    """Maps each folder below a folder src to the folders whose private headers its files include."""
    result = {}
    for file, includes in graph.items():
        if 'src' in file.parts[1:-2]:
            result.setdefault(file.parent, set()).update(i.parent for i in includes if 'src' in i.parts and i.parent != file.parent)
    return result


def rooms(graph):
    """
    Maps each folder within a library, and within `actions` and `base`, to the folders of this library whose headers its files include.

    The table of docs/architecture.md names the libraries, and so forbids circles among them (arrows_test.py).
    """
    libraries = read_arrows(ARROWS.search((SOURCE / 'docs/architecture.md').read_text(encoding='utf-8')).group(1))
    result = {}
    for file, includes in graph.items():
        library = Path(room_of(file, libraries))
        if file.parent != library:
            result.setdefault(file.parent, set()).update(
                i.parent for i in includes if room_of(i, libraries) == str(library) and i.parent not in (library, file.parent))
    return result


def find_circle(graph):
    """Returns the files of one circle, in the order of their includes, or an empty list."""
    finished = set()
    for start in sorted(graph):
        path = []
        pending = [(start, False)]
        while pending:
            file, left = pending.pop()
            if left:
                path.pop()
                finished.add(file)
            elif file in path:
                return path[path.index(file):] + [file]
            elif file not in finished and file in graph:
                path.append(file)
                pending.append((file, True))
                pending.extend((included, False) for included in sorted(graph[file], reverse=True))
    return []


class IncludeCircles(unittest.TestCase):

    def test_no_files_include_one_another_in_a_circle(self):
        graph = include_graph()
        self.assertGreater(sum(len(includes) for includes in graph.values()), 500, 'the includes are found')
        circle = find_circle(graph)
        self.assertEqual(circle, [], 'a circle: ' + ' → '.join(str(file) for file in circle))

    def test_no_folders_within_a_library_include_one_another_in_a_circle(self):
        graph = rooms(include_graph())
        self.assertIn(Path('launcher/run/start'), graph[Path('launcher/run/system_test')])
        self.assertIn(Path('base/text'), graph[Path('base/diagnostics')])
        circle = find_circle(graph)
        self.assertEqual(circle, [], 'a circle: ' + ' → '.join(str(folder) for folder in circle))

    def test_no_files_of_the_stack_include_one_another_in_a_circle(self):
        graph = stack_include_graph()
        self.assertGreater(sum(len(includes) for includes in graph.values()), 1000, 'the includes are found')
        circle = find_circle(graph)
        self.assertEqual(circle, [], 'a circle: ' + ' → '.join(str(file) for file in circle))

    def test_no_folders_of_a_library_of_the_stack_include_one_another_in_a_circle(self):
        graph = folders(stack_include_graph())
        self.assertIn(Path('rmw/src/wait'), graph)
        circle = find_circle(graph)
        self.assertEqual(circle, [], 'a circle: ' + ' → '.join(str(folder) for folder in circle))

    def test_no_python_modules_import_one_another_in_a_circle(self):
        graph = import_graph()
        self.assertIn('launch._values', graph['launch.actions._processes'])
        circle = find_circle(graph)
        self.assertEqual(circle, [], 'a circle: ' + ' → '.join(circle))

    def test_a_circle_is_found(self):
        a, b, c, d = (Path(name) for name in 'abcd')
        self.assertEqual(find_circle({a: {b, d}, b: {c}, c: {d}, d: set()}), [])
        self.assertEqual(find_circle({a: {b}, b: {c, d}, c: {b}, d: set()}), [b, c, b])


if __name__ == '__main__':
    unittest.main()
