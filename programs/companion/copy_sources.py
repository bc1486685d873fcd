#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""copy_sources.py ROOT DESTINATION: copies what the package launch_companion is made of.

These are the sources of the rooms below, the headers that they include, directly or not, and the sources of the same name
beside those headers.
"""

import filecmp
import os
import re
import shutil
import sys

ROOMS = ('programs/ros', 'programs/ros_client', 'programs/type_supports', 'programs/companion/installed_types', 'launcher/message_types',
         'base/conditions', 'base/diagnostics')
# A source whose header has another name, and what a ROS 2 may lack: Humble's rcutils has no hashes.
OTHERS = ('launcher/frontend/yaml11.cpp', 'instrumented_stack/fastcdr_versions/include/fastcdr_versions/cdr.hpp',
          'instrumented_stack/rcutils/include/rcutils/sha256.h', 'instrumented_stack/rcutils/src/sha256.cpp')
# Headers of these are used for their types alone.
HEADERS_ONLY = ('launcher/frontend/frontend.hpp', 'launcher/language/', 'launcher/process/', 'launcher/visit/')


def sources(root):
    found = set()
    left = list(OTHERS)
    for room in ROOMS:
        for folder, _, names in os.walk(os.path.join(root, room)):
            left += [os.path.relpath(os.path.join(folder, name), root) for name in names if name.endswith(('.cpp', '.hpp'))]
    while left:
        path = left.pop()
        if path in found or not os.path.exists(os.path.join(root, path)):
            continue
        found.add(path)
        with open(os.path.join(root, path), encoding='utf-8') as file:
            left += re.findall(r'^#include "([a-z].*)"', file.read(), re.MULTILINE)
        if path.endswith('.hpp') and not path.startswith(HEADERS_ONLY):
            left.append(path[:-4] + '.cpp')
    return found


def copy(origin, to):
    """Leaves a file alone that is the same, so that nothing is compiled again without need."""
    os.makedirs(os.path.dirname(to), exist_ok=True)
    if not os.path.exists(to) or not filecmp.cmp(origin, to, shallow=False):
        shutil.copyfile(origin, to)


def main():
    root, destination = sys.argv[1:]
    wanted = sources(root)
    for path in wanted:
        copy(os.path.join(root, path), os.path.join(destination, 'source', path))
    for folder, _, names in os.walk(os.path.join(destination, 'source')):
        for name in names:
            path = os.path.join(folder, name)
            if os.path.relpath(path, os.path.join(destination, 'source')) not in wanted:
                os.remove(path)


if __name__ == '__main__':
    main()
