# SPDX-License-Identifier: Apache-2.0
"""What `launch build` prints: a line for each package, the errors at their place, a line at the end."""

import os
import re
import shutil
import sys
from pathlib import Path
from typing import Dict, List, Optional

from .jobs import Builder, Observer, Result
from .log_errors import short_errors
from .package_xml import Package
from .test_results import TestCounts


class Output(Observer):
    def __init__(self, number: int):
        self._number, self._ended = number, 0
        self._running: Dict[str, Package] = {}
        self._terminal = sys.stdout.isatty() and os.environ.get('TERM', '') not in ('', 'dumb')
        self._status = False
        self.builder: Optional[Builder] = None

    def started(self, package: Package) -> None:
        self._running[package.name] = package
        self.refresh()

    def ended(self, result: Result) -> None:
        self._running.pop(result.package.name, None)
        self._ended += 1
        self._clear()
        width = len(str(self._number))
        if not result.failed_step:
            what = f' {result.seconds:.1f} s' + (f', {result.tests}' if result.tests else '')
        elif result.tests and result.tests.failed:
            what = f': {result.tests}'
        else:
            what = f': {FAILED[result.failed_step]}'
        print(f'[{self._ended:{width}}/{self._number}] {result.package.name}{what}', flush=True)
        if result.failed_step and result.log:
            for line in short_errors(result.log.read_text(errors='replace')):
                print(f'    {line}')
            print(f'    all of it: {os.path.relpath(result.log)}', flush=True)
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
        text = f'[{self._ended}/{self._number}] ' + ', '.join(parts)
        self._clear()
        print(text[:shutil.get_terminal_size().columns - 1], end='', flush=True)
        self._status = True

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
