# SPDX-License-Identifier: Apache-2.0
"""Arguments of launches on command lines."""


def parse_launch_arguments(launch_arguments):
    """Pairs of the texts NAME:=VALUE; the last value of a name counts."""
    parsed = {}
    for argument in launch_arguments:
        name, separator, value = argument.partition(':=')
        if not separator or not name:
            raise RuntimeError(f"malformed launch argument '{argument}', expected format '<name>:=<value>'")
        parsed[name] = value
    return list(parsed.items())
