# SPDX-License-Identifier: Apache-2.0
"""How many tests of a package passed, from the JUnit XML that CTest or pytest writes."""

from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree


@dataclass
class TestCounts:
    number: int = 0  # of tests, without those that were skipped, and those that the package has disabled
    failed: int = 0
    skipped: int = 0

    def __add__(self, other: 'TestCounts') -> 'TestCounts':
        return TestCounts(self.number + other.number, self.failed + other.failed, self.skipped + other.skipped)

    def __str__(self) -> str:
        if self.number == 0:
            text = 'no tests'
        elif self.failed:
            text = f'{self.failed} of {_tests(self.number)} failed'
        else:
            text = f'{_tests(self.number)} passed'
        return text + (f', {self.skipped} skipped' if self.skipped else '')


def _tests(number: int) -> str:
    return f'{number} test' + ('' if number == 1 else 's')


def read_counts(file: Path) -> TestCounts:
    """No tests, if there is no such file or a killed program left it unfinished."""
    try:
        suites = list(ElementTree.parse(file).getroot().iter('testsuite'))
    except (OSError, ElementTree.ParseError):
        return TestCounts()

    def total(*names: str) -> int:
        return sum(int(suite.get(name) or 0) for suite in suites for name in names)

    skipped = total('skipped')
    return TestCounts(total('tests') - skipped - total('disabled'), total('failures', 'errors'), skipped)
