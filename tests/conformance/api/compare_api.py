#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""
Compares the public headers of this stack with those of ROS 2, which are not part of the repository.

    compare_api.py --ros2 FOLDER --build build/dev [--markdown docs/compatibility.md] [--list]

FOLDER has the sources of rcutils, rcpputils, rcl, rclcpp, class_loader, pluginlib and ament_index, at any depth; folders of
other packages beside them (rmw, rosidl) make the reading more exact. Every class, function, type and macro is present in
this stack, or missing with the reason that deliberate_api_differences.tsv gives for it.
"""

import argparse
import collections
import csv
import pathlib
import re
import sys

from declarations import declarations_of, headers_below

HERE = pathlib.Path(__file__).parent
SOURCES = HERE.parents[2]
PACKAGES = ('rcutils', 'rcpputils', 'rcl', 'rcl_yaml_param_parser', 'rcl_action', 'rcl_lifecycle', 'rclcpp', 'rclcpp_action',
            'rclcpp_lifecycle', 'rclcpp_components', 'class_loader', 'pluginlib', 'ament_index_cpp')
BEGIN, END = '<!-- written by tests/conformance/api/compare_api.py -->\n', '<!-- end -->\n'

Missing = collections.namedtuple('Missing', 'package header name what reason')


def packages_below(folder):
    """The folders `include` of the packages below a folder, by package."""
    return {path.parent.name: path.parent / 'include' for path in sorted(folder.rglob('package.xml'))
            if (path.parent / 'include').is_dir()}


def version_of(include):
    return re.search(r'<version>(.*?)</version>', (include.parent / 'package.xml').read_text())[1]


class Ours:
    """What this stack declares; members are looked up in base classes and behind aliases, too."""

    def __init__(self, declarations):
        self.declarations = declarations
        self.by_last_name = collections.defaultdict(list)
        for name, declaration in declarations.items():
            if declaration.kind in ('class', 'alias'):
                self.by_last_name[name.split('::')[-1]].append(name)

    def classes_of(self, name, seen):
        """The class itself, and all that it is derived from or stands for."""
        if name in seen:
            return
        seen.add(name)
        yield name
        if name in self.declarations:
            for base in self.declarations[name].bases:
                for candidate in self.by_last_name[base.split('::')[-1]]:
                    if candidate.endswith(base) or base.endswith(candidate) or len(self.by_last_name[base.split('::')[-1]]) == 1:
                        yield from self.classes_of(candidate, seen)

    def arities(self, name):
        """With how many arguments a function can be called, or None if nothing has this name."""
        if '::' not in name:
            return self.declarations[name].arities if name in self.declarations else None
        scope, last = name.rsplit('::', 1)
        found = [self.declarations[f'{owner}::{last}'] for owner in self.classes_of(scope, set())
                 if f'{owner}::{last}' in self.declarations]
        if not found:
            return None
        return set().union(*(declaration.arities for declaration in found))


def difference(name, declaration, ours):
    """What this stack lacks of a declaration, as words, or None."""
    scope = name.rsplit('::', 1)[0] if '::' in name else ''
    constructor = '::' in name and scope.rsplit('::', 1)[-1] == name.rsplit('::', 1)[-1] and declaration.kind == 'function'
    if constructor and scope not in ours.declarations:
        return None  # the class itself is reported
    arities = ours.arities(name)
    if arities is None:
        return None if constructor and declaration.arities <= {0, 1} else 'missing'
    if declaration.kind != 'function' or ours.declarations.get(name, declaration).kind not in ('function', 'using'):
        return None
    lacking = sorted(declaration.arities - arities - ({0, 1} if constructor else set()))
    return f'not with {" or ".join(map(str, lacking))} argument{"" if lacking == [1] else "s"}' if lacking else None


class Reasons:
    def __init__(self):
        with open(HERE / 'deliberate_api_differences.tsv', newline='') as table:
            self.rows = [(re.compile(row['pattern']), row['reason']) for row in csv.DictReader(table, delimiter='\t')]
        self.used = set()

    def of(self, *texts):
        for index, (pattern, reason) in enumerate(self.rows):
            if any(pattern.fullmatch(text) for text in texts):
                self.used.add(index)
                return reason
        return None

    def unused(self):
        return [pattern.pattern for index, (pattern, _) in enumerate(self.rows) if index not in self.used]


def compare(ros2, build, reasons):
    theirs = packages_below(ros2)
    ours = packages_below(SOURCES / 'instrumented_stack')
    generated = sorted({path for path in build.glob('instrumented_stack/**/include') if path.is_dir()} |
                       {path for path in build.glob('instrumented_stack/**/rosidl_generator_cpp') if path.is_dir()})
    our_folders = list(ours.values()) + sorted(SOURCES.glob('instrumented_stack/**/include')) + generated
    read, errors = declarations_of(
        [header for package in PACKAGES if package in ours for header in headers_below(ours[package])], our_folders,
        our_folders, with_inner=True)
    for error in errors:
        print(f'in our headers: {error}', file=sys.stderr)
    ours_found = Ours(read)
    rows, missing = [], []
    for package in PACKAGES:
        headers = headers_below(theirs[package])
        found, errors = declarations_of(headers, list(theirs.values()) + our_folders, [theirs[package]])
        for error in errors:
            print(f'in {package}: {error}', file=sys.stderr)
        lost_headers = [header for header in headers
                        if not any((folder / header).is_file() for folder in our_folders)]
        lost = []
        for name, declaration in sorted(found.items()):
            what = difference(name, declaration, ours_found)
            if what is None:
                continue
            parent = name
            while '::' in parent and not (parent in {item.name for item in lost} and parent != name):
                parent = parent.rsplit('::', 1)[0]
            if parent != name and parent in {item.name for item in lost}:
                lost.append(Missing(package, declaration.header, name, what, 'inner'))
            else:
                lost.append(Missing(package, declaration.header, name, what, reasons.of(name, declaration.header)))
        rows.append((package, version_of(theirs[package]), len(headers), len(headers) - len(lost_headers), len(found),
                     len(found) - len(lost)))
        missing += lost
        missing += [Missing(package, header, header, 'header', reasons.of(header)) for header in lost_headers]
    return rows, missing


def markdown(rows, missing):
    lines = ['| package | version | headers | of them here | names | of them here |', '| --- | --- | --- | --- | --- | --- |']
    lines += ['| `{}` | {} | {} | {} | {} | {} |'.format(*row) for row in rows]
    groups = collections.defaultdict(list)
    for item in missing:
        if item.reason != 'inner':
            groups[item.reason].append(item)
    lines += ['', '| missing | reason |', '| --- | --- |']
    for reason, items in groups.items():
        names = [f'`{item.name}`' + ('' if item.what in ('missing', 'header') else f' ({item.what})') for item in items]
        lines.append(f'| {", ".join(names)} | {reason or "**not decided**"} |')
    return '\n'.join(lines) + '\n'


def main():
    arguments = argparse.ArgumentParser(description='Compares the public headers of this stack with those of ROS 2.')
    arguments.add_argument('--ros2', type=pathlib.Path, required=True, help='a folder with sources of ROS 2')
    arguments.add_argument('--build', type=pathlib.Path, required=True, help='a build tree, for headers that are generated')
    arguments.add_argument('--markdown', type=pathlib.Path, help='the page whose table is written anew')
    arguments.add_argument('--list', action='store_true', help='prints what is missing without a reason')
    options = arguments.parse_args()
    reasons = Reasons()
    rows, missing = compare(options.ros2, options.build.resolve(), reasons)
    open_ones = [item for item in missing if item.reason is None]
    if options.list:
        for item in open_ones:
            print(f'{item.package}\t{item.header}\t{item.name}\t{item.what}')
    for pattern in reasons.unused():
        print(f'a reason that nothing needs: {pattern}', file=sys.stderr)
    if options.markdown:
        before, rest = options.markdown.read_text().split(BEGIN)
        options.markdown.write_text(before + BEGIN + markdown(rows, missing) + END + rest.split(END)[1])
    return 1 if open_ones else 0


if __name__ == '__main__':
    sys.exit(main())
