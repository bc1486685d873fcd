# SPDX-License-Identifier: Apache-2.0
"""
Names the targets that the tests matching a regular expression need, one a line: test_targets.py TABLE REGEX.

TABLE is a file of the build: a row `target <tab> what it runs beside itself <tab> source <tab> source …` for each test program. CTest knows the cases of a
program only once it is built, so their names are read from the sources. No line: no test is known to match, and
everything must be built.
"""

import re
import sys

CASE = re.compile(r'^(TEST|TEST_F|TEST_P|TYPED_TEST)\(\s*(\w+),\s*(\w+)\)', re.MULTILINE)
PREFIX = re.compile(r'^INSTANTIATE_\w*TEST_SUITE_P\(\s*(\w*),\s*(\w+)', re.MULTILINE)


def case_names(text):
    """The names of the cases in a source, as --gtest_filter takes them; of parametrized ones, the first."""
    prefixes = PREFIX.findall(text)
    for kind, suite, name in CASE.findall(text):
        if kind in ('TEST', 'TEST_F'):
            yield f'{suite}.{name}'
        elif kind == 'TYPED_TEST':
            yield f'{suite}/0.{name}'
        else:
            for prefix, instantiated in prefixes:
                if instantiated == suite:
                    yield f'{prefix}/{suite}.{name}/0' if prefix else f'{suite}.{name}/0'


def targets(table, pattern):
    """Yields the targets to build for the tests whose name matches, in the order of the table."""
    matches = re.compile(pattern).search
    for row in table.splitlines():
        target, needs, *sources = row.split('\t')
        names = [target]  # the test itself, if it is no program of cases
        for source in sources:
            with open(source, encoding='utf-8') as file:
                names += [f'{target}.{case}' for case in case_names(file.read())]
        if any(map(matches, names)):
            yield from needs.split() or [target]


if __name__ == '__main__':
    with open(sys.argv[1], encoding='utf-8') as file:
        print('\n'.join(dict.fromkeys(targets(file.read(), sys.argv[2]))))
