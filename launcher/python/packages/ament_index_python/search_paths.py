# SPDX-License-Identifier: Apache-2.0
"""The prefixes that are searched for packages."""

import os


def get_search_paths():
    prefixes = os.environ.get('AMENT_PREFIX_PATH', '')
    if not prefixes:
        raise OSError("environment variable 'AMENT_PREFIX_PATH' is not set or empty")
    return [prefix for prefix in prefixes.split(os.pathsep) if prefix and os.path.isdir(prefix)]
