# SPDX-License-Identifier: Apache-2.0
"""The stub of the module launch_trace says what the module has."""

import ast
import functools
import importlib.util
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import launch_trace

TRACES = Path(os.environ['TRACES'])
MODULES = Path(launch_trace.__file__).parent.parent
STUB = MODULES / 'launch_trace/_events.pyi'
HAS_MYPY = importlib.util.find_spec('mypy') is not None

PROGRAM = """
import launch_trace

trace = launch_trace.Trace('directory', damage_is_error=False)
for event in trace.events('ros2:*'):
    reveal_type(event.time_ns)
for item in trace:
    if isinstance(item, launch_trace.Loss):
        reveal_type(item.count)
    else:
        reveal_type(item.procname)
trace.columns('name', 3)
"""

PROGRAM_WITH_TABLES = """
import launch_trace

run = launch_trace.open('directory')
reveal_type(run.messages)
reveal_type(run.chain('/a', '/b').instances)
launch_trace.open(3)
"""


def classes_of_stub():
    tree = ast.parse(STUB.read_text())
    return {node.name: node for node in tree.body if isinstance(node, ast.ClassDef)}


def members_of_stub(node):
    return {member.name: member for member in node.body if isinstance(member, ast.FunctionDef)}


def is_public(name):
    return not name.startswith('_')


class NewNotation(ast.NodeTransformer):
    """Union[A, B] and Optional[A] become A | B and A | None."""

    def visit_Subscript(self, node):
        self.generic_visit(node)
        name = ast.unparse(node.value)
        if name not in ('Optional', 'Union'):
            return node
        parts = node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]
        return functools.reduce(lambda left, right: ast.BinOp(left, ast.BitOr(), right),
                                parts + [ast.Constant(None)] * (name == 'Optional'))


def in_new_notation(said):
    """What mypy says, with the types in its quotation marks as newer versions write them."""
    return re.sub(r'"([^"]*)"', lambda match: f'"{ast.unparse(NewNotation().visit(ast.parse(match[1], mode="eval")))}"', said)


class Stub(unittest.TestCase):

    def test_names_are_those_of_the_module(self):
        self.assertEqual(sorted(classes_of_stub()), sorted(set(launch_trace.__all__) - {'open'}))

    def test_members_are_those_of_the_classes(self):
        for name, node in classes_of_stub().items():
            if name == 'TraceError':
                continue
            members = members_of_stub(node)
            runtime = getattr(launch_trace, name)
            self.assertEqual(sorted(filter(is_public, members)), sorted(filter(is_public, vars(runtime))), name)
            for member in members:
                self.assertTrue(hasattr(runtime, member), f'{name}.{member}')

    def test_attributes_have_the_types_of_the_stub(self):
        for item in launch_trace.Trace(TRACES / 'whole'):
            for name, member in members_of_stub(classes_of_stub()[type(item).__name__]).items():
                if not any(isinstance(each, ast.Name) and each.id == 'property' for each in member.decorator_list):
                    continue
                type_name = ast.unparse(member.returns)
                value = getattr(item, name)
                if type_name.startswith('Literal'):
                    self.assertIn(repr(value), type_name)
                else:
                    self.assertIn(type(value).__name__.replace('NoneType', 'None'),
                                  [part.split('[')[0] for part in type_name.split(' | ')], name)

    @unittest.skipUnless(HAS_MYPY, 'mypy is not installed')
    def test_stubtest_finds_nothing(self):
        with tempfile.TemporaryDirectory() as directory:
            # The classes have the metaclass of pybind11, which has no types.
            allowed = Path(directory, 'allowed')
            allowed.write_text('launch_trace._events.Loss\nlaunch_trace._events.Loss.__init__\nlaunch_trace._events.Trace\n')
            result = subprocess.run(
                [sys.executable, '-m', 'mypy.stubtest', '--allowlist', str(allowed), 'launch_trace._events'], cwd=directory,
                capture_output=True, text=True, env={**os.environ, 'MYPYPATH': str(MODULES)})
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    @unittest.skipUnless(HAS_MYPY, 'mypy is not installed')
    def test_mypy_finds_the_types(self):
        with tempfile.TemporaryDirectory() as directory:
            program = Path(directory, 'program.py')
            program.write_text(PROGRAM)
            result = subprocess.run([sys.executable, '-m', 'mypy', '--cache-dir', directory, str(program)],
                                    capture_output=True, text=True, cwd=directory)
            said = in_new_notation(result.stdout.replace(str(program), 'program.py'))
        self.assertEqual(said.splitlines()[:4], [
            'program.py:6: note: Revealed type is "builtins.int"',
            'program.py:9: note: Revealed type is "builtins.int | None"',
            'program.py:11: note: Revealed type is "builtins.str | None"',
            'program.py:12: error: Argument 2 to "columns" of "Trace" has incompatible type "int"; expected '
            '"Sequence[str] | None"  [arg-type]'], said + result.stderr)

    @unittest.skipUnless(HAS_MYPY, 'mypy is not installed')
    def test_mypy_finds_the_types_of_tables(self):
        with tempfile.TemporaryDirectory() as directory:
            program = Path(directory, 'program.py')
            program.write_text(PROGRAM_WITH_TABLES)
            result = subprocess.run([sys.executable, '-m', 'mypy', '--cache-dir', directory, str(program)],
                                    capture_output=True, text=True, cwd=directory)
            said = in_new_notation(result.stdout.replace(str(program), 'program.py'))
        self.assertEqual(said.splitlines()[:3], [
            'program.py:5: note: Revealed type is "launch_trace._table.Table"',
            'program.py:6: note: Revealed type is "launch_trace._table.Table"',
            'program.py:7: error: Argument 1 to "open" has incompatible type "int"; expected '
            '"str | PathLike[str] | Sequence[str | PathLike[str]]"  [arg-type]'], said + result.stderr)


if __name__ == '__main__':
    unittest.main()
