# SPDX-License-Identifier: Apache-2.0
"""The command line of `launch build`."""

import os
import sys
import time
from difflib import get_close_matches
from pathlib import Path
from typing import Dict, List, NoReturn, Tuple

if __package__ in (None, ''):
    sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
    __package__ = 'launch_build'

from .jobs import Builder, Options  # noqa: E402
from .output import Output  # noqa: E402
from .package_xml import BUILD_TYPES, PackageError  # noqa: E402
from .prefixes import build_environment, underlays, write_setup_files  # noqa: E402
from .workspace import choose, find_packages, in_order  # noqa: E402

HELP = '''Builds the packages of a workspace with CMake, each after those that it needs.
Usage: launch build [OPTIONS] [PACKAGE...]

Positionals:
  PACKAGE ...                 packages to build, with those of the workspace that they need; all if there is none

Options:
  -h,--help                   Print this help message and exit
  -C,--directory TEXT         the workspace, which gets the folders build and install; default: the current directory
  --from TEXT                 where packages are searched for; may be repeated; default: src, or else the workspace
  --only                      only the named packages, not those that they need
  --list                      only print the packages, in the order in which they are built
  --test                      run the tests of the packages, too
  --no-tests                  build no tests (-DBUILD_TESTING=OFF)
  --merge-install             install all packages into one prefix and not each into its own
  --cmake-args TEXT ...       arguments of CMake, up to the next word that begins with '--'
  --continue                  go on with packages that do not need one that has failed
  -j,--jobs TEXT              how many processors are used; default: all

Then `source install/setup.bash`. Packages are built against the prefixes in AMENT_PREFIX_PATH, or else against this
stack. The build type is RelWithDebInfo unless --cmake-args names another one.
'''
VALUES = {'-C': 'directory', '--directory': 'directory', '--from': 'from', '-j': 'jobs', '--jobs': 'jobs'}
FLAGS = ('--only', '--list', '--test', '--no-tests', '--merge-install', '--continue')


def usage_error(what: str) -> NoReturn:
    print(f"launch build: error: {what}\n      = help: see 'launch build --help'", file=sys.stderr)
    sys.exit(2)


def parse(words: List[str]) -> Tuple[List[str], Dict[str, List[str]]]:
    """Returns the packages, and the values of the options."""
    names: List[str] = []
    options: Dict[str, List[str]] = {}
    index = 0
    while index < len(words):
        word, _, value = words[index].partition('=')
        index += 1
        if word in ('-h', '--help'):
            print(HELP, end='')
            sys.exit(0)
        if word == '--cmake-args':
            while index < len(words) and not words[index].startswith('--'):
                options.setdefault('cmake-args', []).append(words[index])
                index += 1
        elif word in VALUES:
            if not value:
                if index == len(words):
                    usage_error(f'{word} needs a value')
                value = words[index]
                index += 1
            options.setdefault(VALUES[word], []).append(value)
        elif word in FLAGS and not value:
            options[word[2:]] = []
        elif word.startswith('-'):
            near = get_close_matches(word, [*VALUES, *FLAGS, '--cmake-args', '--help'], 1)
            usage_error(f"unknown option '{word}'" + (f"\n      = help: did you mean '{near[0]}'?" if near else ''))
        else:
            names.append(words[index - 1])
    return names, options


def main(words: List[str]) -> int:
    names, options = parse(words)
    workspace = Path(options.get('directory', ['.'])[-1])
    if not workspace.is_dir():
        usage_error(f"there is no folder '{workspace}'")
    workspace = workspace.resolve()
    jobs = options.get('jobs', [str(len(os.sched_getaffinity(0)))])[-1]
    if not jobs.isdigit() or int(jobs) == 0:
        usage_error(f"--jobs must be a number above 0, and not '{jobs}'")
    folders = [Path(folder) for folder in options.get('from', [])]
    for folder in folders:
        if not folder.is_dir():
            usage_error(f"there is no folder '{folder}'")
    install = workspace / 'install'
    below = [prefix for prefix in underlays(os.environ) if prefix != install and install not in prefix.parents]
    environment = build_environment(os.environ, [])
    try:
        packages = find_packages(folders or [workspace / 'src' if (workspace / 'src').is_dir() else workspace], environment)
        packages = {name: package for name, package in packages.items()
                    if not {workspace / 'build', install} & set(package.folder.resolve().parents)}
        if not packages:
            raise PackageError(f"error: there is no package.xml below '{folders[0] if folders else workspace}'")
        chosen = choose(names, packages, 'only' in options)
        order = in_order(chosen)
        for package in order:
            if package.build_type not in BUILD_TYPES:
                raise PackageError(f"error: package '{package.name}' has the build type '{package.build_type}'; "
                                   f'there are {", ".join(BUILD_TYPES)}\n  {package.folder}')
    except PackageError as error:
        text = str(error)
        print(f'launch build: {text}' if text.startswith('error: ') else text, file=sys.stderr)
        return 1
    if 'list' in options:
        for package in order:
            print(f'{package.name} {os.path.relpath(package.folder)}')
        return 0
    return build(order, packages, Options(
        build=workspace / 'build', install=install, underlays=below, environment=environment, jobs=int(jobs),
        merge_install='merge-install' in options, cmake_arguments=options.get('cmake-args', []),
        tests='no-tests' not in options, run_tests='test' in options, go_on='continue' in options))


def build(order, packages, options: Options) -> int:  # type: ignore[no-untyped-def]
    begin = time.monotonic()
    write_setup_files(options.install, options.underlays)
    output = Output(len(order))
    output.builder = Builder(order, packages, options, output)
    results = output.builder.run()
    return output.finish(results, output.builder.skipped, time.monotonic() - begin, output.builder.interrupted)


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
