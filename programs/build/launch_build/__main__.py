# SPDX-License-Identifier: Apache-2.0
"""Runs `launch build`."""

import os
import sys
import time
from pathlib import Path
from typing import Dict, List

if __package__ in (None, ''):
    sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
    __package__ = 'launch_build'

from .command_line import parse, usage_error  # noqa: E402
from .debian_packages import missing_packages  # noqa: E402
from .jobs import Builder, Options  # noqa: E402
from .output import Output  # noqa: E402
from .package_xml import BUILD_TYPES, Package, PackageError  # noqa: E402
from .prefixes import build_environment, underlays, write_setup_files  # noqa: E402
from .workspace import choose, find_packages, in_order  # noqa: E402


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
        order = in_order(chosen_packages(names, options, packages))
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
    missing = missing_packages(order, packages, below, tests='no-tests' not in options)
    if 'missing' in options:
        for name in sorted({name for names in missing.values() for name in names}):
            print(name)
        return 0
    return build(order, packages, missing, Options(
        build=workspace / 'build', install=install, underlays=below, environment=environment, jobs=int(jobs),
        merge_install='merge-install' in options, cmake_arguments=options.get('cmake-args', []),
        tests='no-tests' not in options, run_tests='test' in options, go_on='continue' in options,
        ccache='no-ccache' not in options))


def chosen_packages(names: List[str], options: Dict[str, List[str]], packages: Dict[str, Package]) -> Dict[str, Package]:
    """What the command line names; all packages if it names none."""
    chosen = choose(names + options.get('packages-up-to', []), packages, 'only' in options)
    if 'packages-select' in options:
        selected = choose(options['packages-select'], packages, only=True)
        chosen = {**chosen, **selected} if names or 'packages-up-to' in options else selected
    if 'packages-skip' in options:
        skipped = choose(options['packages-skip'], packages, only=True)
        chosen = {name: package for name, package in chosen.items() if name not in skipped}
    return chosen


def build(order, packages, missing, options: Options) -> int:  # type: ignore[no-untyped-def]
    begin = time.monotonic()
    write_setup_files(options.install, options.underlays)
    output = Output(order, missing, options.build)
    output.builder = Builder(order, packages, options, output)
    results = output.builder.run()
    return output.finish(results, output.builder.skipped, time.monotonic() - begin, output.builder.interrupted)


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
