# SPDX-License-Identifier: Apache-2.0
"""What `launch build` prints: a line for each package, the errors at their place, a line at the end."""

import os
import re
import shutil
import sys
import time
from pathlib import Path
from typing import Dict, List, Mapping, Optional, Sequence

from .estimate import Estimate, in_words
from .jobs import Builder, Observer, Result
from .log_errors import short_errors
from .package_xml import Package
from .test_results import TestCounts


class Output(Observer):
    """`missing` are the packages of Debian that packages name and that are not installed; `build` holds the build trees."""

    def __init__(self, order: Sequence[Package], missing: Mapping[str, List[str]], build: Path):
        self._number, self._ended = len(order), 0
        self._missing = missing
        self._begin = time.monotonic()
        self._estimate = Estimate((package.name for package in order), build)
        self._running: Dict[str, Package] = {}
        self._terminal = sys.stdout.isatty() and os.environ.get('TERM', '') not in ('', 'dumb')
        self._status = False
        self.builder: Optional[Builder] = None
        names = sorted({name for names in missing.values() for name in names})
        if names:
            print(f'not installed, though {_packages(len(missing))} of the workspace need{"s" if len(missing) == 1 else ""} it: '
                  f'sudo apt install {" ".join(names)}', flush=True)

    def started(self, package: Package) -> None:
        self._running[package.name] = package
        self.refresh()

    def ended(self, result: Result) -> None:
        self._running.pop(result.package.name, None)
        self._ended += 1
        self._estimate.ended(result.package.name, result.seconds, not result.failed_step)
        self._clear()
        width = len(str(self._number))
        if not result.failed_step:
            what = f' {result.seconds:.1f} s' + (f', {result.tests}' if result.tests else '')
        elif result.tests and result.tests.failed:
            what = f': {result.tests}'
        else:
            what = f': {FAILED[result.failed_step]}'
        left = self._left()
        if self._terminal or left is None or left < LEAST_TO_SAY:
            left = None
        print(f'[{self._ended:{width}}/{self._number}] {result.package.name}{what}'
              + (f' ({in_words(left)})' if left is not None else ''), flush=True)
        if result.failed_step and result.log:
            for line in short_errors(result.log.read_text(errors='replace')):
                print(f'    {line}')
            print(f'    all of it: {os.path.relpath(result.log)}', flush=True)
            missing = self._missing.get(result.package.name)
            if missing:
                print(f'    not installed: {", ".join(missing)}', flush=True)
        self.refresh()

    def refresh(self) -> None:
        """On a terminal, the last line says what is being built and how far it is."""
        if not self._terminal or not self._running:
            return
        parts = []
        for name in self._running:
            log = self.builder.logs.get(name) if self.builder else None
            step = _progress(log) if log else ''
            parts.append(f'{name} {step}'.strip())
        left = self._left()
        text = f'[{self._ended}/{self._number}] ' + (f'{in_words(left)}: ' if left is not None else '') + ', '.join(parts)
        self._clear()
        print(text[:shutil.get_terminal_size().columns - 1], end='', flush=True)
        self._status = True

    def _left(self) -> Optional[float]:
        """Seconds, if something is left and enough is known."""
        return self._estimate.seconds_left(time.monotonic() - self._begin) if self._ended < self._number else None

    def _clear(self) -> None:
        if self._status:
            print('\r\033[K', end='')
            self._status = False

    def finish(self, results: List[Result], skipped: List[Package], seconds: float, interrupted: bool) -> int:
        self._clear()
        failed = [result for result in results if result.failed_step]
        built = len(results) - len([result for result in failed if result.failed_step != 'test'])
        if interrupted:
            print(f'launch build: interrupted, {self._ended} of {self._number} packages were built')
            return 130
        text = f'{_packages(built)} built in {seconds:.1f} s'
        tests = [result.tests for result in results if result.tests]
        if tests:
            text += f', {sum(tests, TestCounts())}'
        if failed:
            text += f', failed: {", ".join(result.package.name for result in failed)}'
        if skipped:
            text += f', not built: {", ".join(package.name for package in skipped)}'
        print(text)
        return 1 if failed else 0


LEAST_TO_SAY = 60  # seconds that are left, where each package has a line

FAILED = {'configure': 'CMake could not configure it', 'build': 'it does not compile', 'install': 'it could not be installed',
          'test': 'tests fail'}


def _packages(number: int) -> str:
    return f'{number} package' + ('' if number == 1 else 's')


def _progress(log: Path) -> str:
    """(12/40), as ninja counts it at the end of its output."""
    try:
        with open(log, 'rb') as file:
            file.seek(max(0, os.path.getsize(log) - 4096))
            found = re.findall(rb'^\[(\d+/\d+)\]', file.read(), re.MULTILINE)
    except OSError:
        return ''
    return f'({found[-1].decode()})' if found else ''
