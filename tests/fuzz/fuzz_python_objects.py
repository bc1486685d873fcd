#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""
Gives the launcher random trees of Python objects and looks whether it ends by itself, with JSON and with errors that are
explained: fuzz_python_objects.py LAUNCH [--seconds N | --trees N] [--first SEED]

A tree comes from its seed alone, so `--first SEED --trees 1` repeats it.
"""

import argparse
import collections
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

FILE = Path(__file__).with_name('random_objects.launch.py')
BATCH = 250  # trees of one process


def try_trees(launch, first, count, directory):
    """(what is wrong or '', the findings)"""
    progress = Path(directory) / 'progress'
    environment = {**os.environ, 'RANDOM_OBJECTS': f'{first} {count} {progress}', 'ROS_LOG_DIR': str(directory)}
    try:
        done = subprocess.run([launch, 'check', '--format', 'json', FILE], capture_output=True, text=True, errors='replace',
                              env=environment, cwd=directory, stdin=subprocess.DEVNULL, timeout=600)
    except subprocess.TimeoutExpired:
        return f'seed {progress.read_text()}: no end within ten minutes', []
    where = f'seed {progress.read_text() if progress.exists() else first}: '
    if done.returncode not in (0, 1):
        return f'{where}exit code {done.returncode}\n{done.stderr[-3000:]}', []
    try:
        findings = json.loads(done.stdout)
    except ValueError as error:
        return f'{where}{error}: {done.stdout[-300:]!r}\n{done.stderr[-3000:]}', []
    if progress.read_text() != str(first + count - 1):
        return f'{where}the check did not go on\n{json.dumps(findings[-1:])}', []
    for finding in findings:
        if "can't be explained" in finding['message'] or not finding['message'] or not finding['file']:
            return f'{where}{json.dumps(finding)}', []
    return '', findings


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('launch', type=lambda path: Path(path).resolve())
    parser.add_argument('--seconds', type=float, default=60)
    parser.add_argument('--trees', type=int, help='so many trees, however long it takes')
    parser.add_argument('--first', type=int, default=1)
    given = parser.parse_args()
    begin, seed, kinds = time.monotonic(), given.first, collections.Counter()
    with tempfile.TemporaryDirectory() as directory:
        while seed < given.first + given.trees if given.trees else time.monotonic() - begin < given.seconds:
            count = min(BATCH, given.first + given.trees - seed) if given.trees else BATCH
            wrong, findings = try_trees(given.launch, seed, count, directory)
            if wrong:
                print(wrong)
                return 1
            kinds.update(finding['message'].partition("'")[0][:40] for finding in findings)
            seed += count
    print(f'{seed - given.first} trees, {sum(kinds.values())} findings of {len(kinds)} kinds, '
          f'{time.monotonic() - begin:.0f} s: none ended the launcher')
    return 0


if __name__ == '__main__':
    sys.exit(main())
