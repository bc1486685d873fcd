# SPDX-License-Identifier: Apache-2.0
"""Runs campaigns: ./dev campaign [NAME [RUNS]] [--busy [LOOPS]] [--seed SEED] [--keep]"""

import argparse
import importlib
import random
import shutil
import sys
import time

from . import place as places
from .campaign import table

NAMES = ('crashes', 'overload', 'rotations', 'early_ends', 'configurations', 'deaths', 'skewed_clocks', 'live_views',
         'false_alarms', 'daemons', 'own_buffers', 'ownership')


def main():
    parser = argparse.ArgumentParser(prog='./dev campaign', description='Many runs of what is hard to record.')
    parser.add_argument('name', nargs='?', choices=NAMES, help='the campaign (default: all of them)')
    parser.add_argument('runs', nargs='?', type=int, help='number of runs (default: that of the campaign)')
    parser.add_argument('--busy', nargs='?', type=int, const=4, default=0, metavar='LOOPS', help='beside busy loops (four)')
    parser.add_argument('--seed', type=int, default=1, help='of the first run (default: 1)')
    parser.add_argument('--keep', metavar='DIR', help='keep the directories of wrong runs there')
    parser.add_argument('--build', default='build/dev', help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    places.enter()
    place = places.Place(arguments.build if arguments.build.startswith('/') else f'{sys.path[0]}/{arguments.build}')
    failed, tables = [], []
    try:
        if arguments.busy:
            place.make_busy(arguments.busy)
        for name in [arguments.name] if arguments.name else NAMES:
            outcomes = run(place, importlib.import_module(f'.{name}', __package__), name, arguments)
            tables.append(table(name + (f', {arguments.busy} busy loops' if arguments.busy else ''), outcomes))
            print('\n'.join(tables[-1]) + '\n', flush=True)
            if any(outcome.wrong for outcome in outcomes):
                failed.append(name)
    finally:
        place.close()
    if failed:
        sys.exit(f"campaign: error: wrong: {', '.join(failed)}")


def run(place, campaign, name, arguments):
    count = arguments.runs or campaign.RUNS
    outcomes = []
    begin = time.monotonic()
    if hasattr(campaign, 'runs'):
        source = campaign.runs(place, random.Random(arguments.seed), count)
    else:
        source = (campaign.run(place, random.Random(seed)) for seed in range(arguments.seed, arguments.seed + count))
    for outcome in source:
        outcomes.append(outcome)
        for sentence in outcome.wrong:
            print(f'{name}, seed {arguments.seed + len(outcomes) - 1}: {sentence}', flush=True)
        if outcome.wrong and arguments.keep:
            shutil.copytree(place.path(), f'{arguments.keep}/{name}-{len(outcomes)}', dirs_exist_ok=True, symlinks=True)
        if sys.stderr.isatty():
            print(f'\r{name} {len(outcomes)} of {count}, {time.monotonic() - begin:.0f} s ', end='', file=sys.stderr)
    return outcomes


main()
