# SPDX-License-Identifier: Apache-2.0
"""Modules that are imported when somebody asks for them: a launch file starts sooner without those that it does not use."""

import sys


def module(package, name, names):
    """The module of this name in the package, for its __getattr__(). `names` are the modules that it has."""
    if name not in names:
        raise AttributeError(f"module '{package}' has no attribute '{name}'", name=name, obj=sys.modules[package])
    full = f'{package}.{name}'
    __import__(full)
    return sys.modules[full]
