#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""
Compares the commands of `launch` with those of ROS 2's ros2cli, whose sources are not part of the repository.

    compare_commands.py --ros2cli FOLDER --launch build/dev/prefix/bin/launch [--list]

FOLDER is a source tree of ros2cli. What each verb declares for argparse is read from its text; no code of it runs. Every verb
and every option is one of `launch COMMAND VERB --help`, or missing with the reason that deliberate_command_differences.tsv
gives for it. The exit code is 1 if something is missing without a reason, or a reason is for nothing.
"""

import argparse
import ast
import csv
import pathlib
import re
import subprocess
import sys

HERE = pathlib.Path(__file__).parent
# Commands that `launch` has under the same name.
COMMANDS = ('action', 'component', 'interface', 'lifecycle', 'node', 'param', 'service', 'topic')


class Declared:
    """The functions of the sources that declare arguments."""

    def __init__(self, folder):
        self._functions = {}  # (package or folder, module, name) or the name alone: (function, imports of its module)
        for path in sorted(folder.rglob('*.py')):
            if 'test' in path.parts:
                continue
            tree = ast.parse(path.read_text(encoding='utf-8'))
            imports = imports_of(tree)
            module = path.parts[-3:-1] if path.stem == '__init__' else (path.parts[-2], path.stem)
            for node in ast.walk(tree):
                if isinstance(node, ast.FunctionDef) and 'add_' in node.name and 'argument' in node.name:
                    self._functions[(*module, node.name)] = node, imports
                    self._functions.setdefault(node.name, (node, imports))

    def options_of(self, function, imports, seen=()):
        """The names of each option that the function declares, also by the functions of this kind that it calls."""
        for node in ast.walk(function):
            if not isinstance(node, ast.Call):
                continue
            called = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, 'id', '')
            if called == 'add_argument':
                yield [word.value for word in node.args if isinstance(word, ast.Constant) and str(word.value).startswith('-')]
                continue
            other = self._functions.get(imports.get(called)) or self._functions.get(called)
            if other is not None and other[0] not in seen and other[0] is not function:
                yield from self.options_of(*other, (*seen, function))


def imports_of(tree):
    """What names of imported functions mean: {name here: (package or folder, module, name there)}."""
    found = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.module:
            parts = node.module.split('.')
            for alias in node.names:
                found[alias.asname or alias.name] = (parts[-2] if len(parts) > 1 else parts[0], parts[-1], alias.name)
    return found


def verbs_of(folder, command, declared):
    """{verb: [names of one option, …]} of a command."""
    verbs = {}
    for path in sorted((folder / f'ros2{command}' / f'ros2{command}' / 'verb').glob('*.py')):
        if path.stem == '__init__':
            continue
        tree = ast.parse(path.read_text(encoding='utf-8'))
        imports = imports_of(tree)
        options = []
        for node in ast.walk(tree):
            if isinstance(node, ast.FunctionDef) and node.name == 'add_arguments':
                options += [names for names in declared.options_of(node, imports) if names]
        verbs[path.stem] = options
    return verbs


def help_of(launch, command, verb):
    result = subprocess.run([launch, command, verb, '--help'], capture_output=True, text=True, check=False)
    return result.stdout if result.returncode == 0 else None


def options_in(text):
    return set(re.findall(r'(?<![\w-])--?[a-zA-Z0-9][\w-]*', text))


def missing(folder, launch):
    """Pairs of "command verb" or "command verb --option", and the names that would do."""
    declared = Declared(folder)
    for command in COMMANDS:
        for verb, options in verbs_of(folder, command, declared).items():
            text = help_of(launch, command, verb)
            if text is None:
                yield f'{command} {verb}'
                continue
            ours = options_in(text)
            for names in options:
                for name in names:
                    if name not in ours:
                        yield f'{command} {verb} {name}'


def main():
    parser = argparse.ArgumentParser(description=__doc__.split('\n\n')[0].strip())
    parser.add_argument('--ros2cli', required=True, type=pathlib.Path)
    parser.add_argument('--launch', required=True)
    parser.add_argument('--list', action='store_true', help='also print what is missing with a reason')
    arguments = parser.parse_args()
    with open(HERE / 'deliberate_command_differences.tsv', encoding='utf-8') as file:
        reasons = [(re.compile(row['pattern']), row['reason']) for row in csv.DictReader(file, delimiter='\t')]
    used = set()
    without = 0
    found = sorted(set(missing(arguments.ros2cli, arguments.launch)))
    for what in found:
        reason = next(((pattern, text) for pattern, text in reasons if pattern.fullmatch(what)), None)
        if reason is None:
            without += 1
            print(f'missing: {what}')
        else:
            used.add(reason[0])
            if arguments.list:
                print(f'{what}: {reason[1]}')
    for pattern, _ in reasons:
        if pattern not in used:
            print(f'a reason for nothing: {pattern.pattern}')
    print(f'{len(found)} missing, {without} of them without a reason')
    return 1 if without or len(used) != len(reasons) else 0


if __name__ == '__main__':
    sys.exit(main())
