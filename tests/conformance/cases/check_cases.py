#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""
Runs cases that users of ROS 2 have reported against the product, and prints for each whether it is right, wrong, or not run.

    check_cases.py --cases FOLDER --build build/dev [NUMBER...]

FOLDER is not part of the repository: INDEX.tsv has a row for each case (number, folder), and each folder the files of one.
What must hold is here, by number. The exit code is 1 if a case is wrong, or has no check.
"""

import argparse
import csv
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import command_cases  # noqa: F401: adds its case
import running_cases
from file_cases import CASES
from place import House, NotRun, Place, Wrong, enter


def verdict(house, number, folder, domain):
    """right, wrong or not run; and why, in few words."""
    if number not in CASES:
        return 'wrong', 'no check of this case'
    wants = CASES[number].__doc__
    place = Place(house, folder, domain)
    try:
        CASES[number](place)
    except NotRun as reason:
        return 'not run', f'because {reason}'
    except Wrong as reason:
        return 'wrong', f'{wants}: {reason}'
    except Exception as error:  # a check that itself fails says nothing good of the product
        return 'wrong', f'{wants}: {type(error).__name__}: {error}'
    finally:
        place.end()
    return 'right', wants


def table(cases, build, numbers=()):
    """[(number, verdict, why)] of the folder's cases, or of these."""
    with open(Path(cases) / 'INDEX.tsv', encoding='utf-8', newline='') as index:
        rows = [(row['id'], row['folder']) for row in csv.DictReader(index, delimiter='\t', quoting=csv.QUOTE_NONE)]
    rows = [row for row in rows if not numbers or row[0] in numbers]
    house = House(cases, build)
    try:
        with ThreadPoolExecutor(max_workers=3) as pool:
            results = {}

            def run(some):
                futures = {number: pool.submit(verdict, house, number, folder, domain)
                           for domain, (number, folder) in enumerate(rows, 1) if number in some}
                results.update((number, future.result()) for number, future in futures.items())

            for number in running_cases.ALONE:
                run([number])
            run({number for number, _ in rows} - set(running_cases.ALONE))
    finally:
        house.close()
    return [(number, *results[number]) for number, _ in rows]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--cases', type=Path, required=True)
    parser.add_argument('--build', type=Path, required=True)
    parser.add_argument('numbers', nargs='*', metavar='NUMBER', help='only these cases')
    options = parser.parse_args()
    enter()
    rows = table(options.cases.resolve(), options.build, options.numbers)
    for number, result, why in rows:
        print(f'{number:<4}  {result:<8}  {why}')
    wrong = sum(result == 'wrong' for _, result, _ in rows)
    print(f'{len(rows)} cases: {wrong} wrong, {sum(result == "not run" for _, result, _ in rows)} not run')
    sys.exit(1 if wrong else 0)


if __name__ == '__main__':
    main()
