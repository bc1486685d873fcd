# SPDX-License-Identifier: Apache-2.0
"""Finds in the output of a build what a person wants to read: the first errors, and nothing else."""

import re
from typing import List

LIMIT = 24  # lines

# Where an error begins, and how many lines belong to it at most.
BEGINS = ((re.compile(r'^\S[^:\n]*:\d+(:\d+)?: (fatal )?error: |^.*: error: '), 4),  # compilers, the generator of messages
          (re.compile(r'^CMake Error( at|:|\b)'), 10),
          (re.compile(r'^ninja: (fatal|error): '), 1),
          (re.compile(r'^.*: undefined reference to |^/usr/bin/ld: |^collect2: error'), 1),
          (re.compile(r'^\s*\d+ - .*\((Failed|Timeout|Not Run|SEGFAULT|Subprocess.*)\)'), 1),  # the summary of ctest
          (re.compile(r'^(Traceback|\w*Error: )'), 12))


def short_errors(output: str) -> List[str]:
    """The first errors, at most LIMIT lines. The last lines of the output if there is nothing that looks like an error."""
    lines = output.splitlines()
    found: List[str] = []
    index = 0
    while index < len(lines) and len(found) < LIMIT:
        length = next((length for begin, length in BEGINS if begin.match(lines[index])), 0)
        if length == 0:
            index += 1
            continue
        end = index + 1
        while end < min(index + length, len(lines)) and _goes_on(lines[index], lines[end]):
            end += 1
        found += lines[index:end]
        index = end
    return [line.rstrip() for line in found[:LIMIT] if line.strip()] or [line for line in lines[-8:] if line.strip()]


def _goes_on(first: str, line: str) -> bool:
    if first.startswith(('CMake Error', 'Traceback')):
        return not line.startswith('--')
    return line.startswith(' ') or not line
