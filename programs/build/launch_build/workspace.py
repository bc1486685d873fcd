# SPDX-License-Identifier: Apache-2.0
"""Finds the packages of a workspace, and the order in which they are built."""

import difflib
import os
from pathlib import Path
from typing import Dict, Iterable, List, Mapping, Set

from .package_xml import Package, PackageError, read_package

# A folder with one of these files is left out, with everything in it.
IGNORED = ('COLCON_IGNORE', 'AMENT_IGNORE', 'CATKIN_IGNORE')


def find_packages(folders: Iterable[Path], environment: Mapping[str, str]) -> Dict[str, Package]:
    """The packages below these folders, by name. A package is a folder with a package.xml; it holds no others."""
    packages: Dict[str, Package] = {}
    for top in folders:
        for folder, below, files in os.walk(top, followlinks=True):
            if any(name in files for name in IGNORED):
                below.clear()
            elif 'package.xml' in files:
                below.clear()
                package = read_package(Path(folder), environment)
                other = packages.setdefault(package.name, package)
                if other is not package and other.folder.resolve() != package.folder.resolve():
                    raise PackageError(f"error: there are two packages '{package.name}':\n  {other.folder}\n  {package.folder}")
            else:
                below[:] = sorted(name for name in below if not name.startswith('.'))
    return packages


def needed(package: Package, packages: Mapping[str, Package]) -> List[str]:
    """The packages of the workspace that this one names."""
    members = [other.name for other in packages.values() if set(other.groups) & set(package.group_depends)]
    return [name for name in dict.fromkeys((*package.depends, *members)) if name in packages and name != package.name]


def all_needed(package: Package, packages: Mapping[str, Package]) -> Set[str]:
    """The packages of the workspace that must be built before this one."""
    found: Set[str] = set()
    waiting = [package]
    while waiting:
        for name in needed(waiting.pop(), packages):
            if name not in found:
                found.add(name)
                waiting.append(packages[name])
    return found


def used(package: Package, packages: Mapping[str, Package]) -> Set[str]:
    """The packages of the workspace that this one finds: what it needs, and what the tests of it and of these need, if that makes
    no circle. A package may export what only its tests need."""
    found: Set[str] = set()
    waiting = [package]
    while waiting:
        one = waiting.pop()
        names = needed(one, packages)
        for name in one.test_depends:
            if name in packages and not {one.name, package.name} & ({name} | all_needed(packages[name], packages)):
                names.append(name)
        for name in names:
            if name not in found:
                found.add(name)
                waiting.append(packages[name])
    return found - {package.name}


def choose(names: List[str], packages: Mapping[str, Package], only: bool) -> Dict[str, Package]:
    """The named packages and, unless `only`, what they need; all without names."""
    chosen: Set[str] = set(names)
    for name in names:
        if name not in packages:
            near = difflib.get_close_matches(name, packages, n=1)
            raise PackageError(f"error: there is no package '{name}' in the workspace"
                               + (f"\n      = help: did you mean '{near[0]}'?" if near else ''))
        if not only:
            chosen |= all_needed(packages[name], packages)
    return {name: package for name, package in packages.items() if not names or name in chosen}


def built_before(packages: Mapping[str, Package]) -> Dict[str, Set[str]]:
    """For each package, those that are built before it: those that it needs, and those that its tests need."""
    before = {name: set(needed(package, packages)) for name, package in packages.items()}
    for name, package in packages.items():
        for other in package.test_depends:
            if other in packages and other != name and name not in all_needed(packages[other], packages) | {other}:
                before[name].add(other)
    return before


def in_order(packages: Mapping[str, Package]) -> List[Package]:
    """Each package comes after those that it needs; otherwise they are in the order of their names."""
    before = built_before(packages)
    order: List[Package] = []
    done: Set[str] = set()
    while len(order) < len(packages):
        ready = sorted(name for name in packages if name not in done and before[name] <= done)
        if not ready:
            raise PackageError('error: these packages need one another: '
                               + ' → '.join(_circle({name: before[name] - done for name in before if name not in done})))
        order.append(packages[ready[0]])
        done.add(ready[0])
    return order


def _circle(before: Mapping[str, Set[str]]) -> List[str]:
    way = [min(before)]
    while way[-1] not in way[:-1]:
        way.append(min(before[way[-1]]))
    return way[way.index(way[-1]):]
