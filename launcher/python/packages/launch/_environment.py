# SPDX-License-Identifier: Apache-2.0
"""The environment and the configurations of the launch, as mappings."""

import os
from collections.abc import MutableMapping

import _launch_engine


_of_launcher = os.environ


def of_process():
    """The environment of this process itself, which tests have that run beside a launch."""
    return _of_launcher


class LaunchVariables(MutableMapping):
    """The launch's environment, or its configurations. Changes take effect in the launch."""

    def __init__(self, environment):
        self._environment = environment

    def __getitem__(self, name):
        if not _launch_engine.is_running():
            return self._outside()[name]
        value = _launch_engine.get(self._environment, self._key(name))
        if value is None:
            raise KeyError(name)
        return value

    def __setitem__(self, name, value):
        if self._environment and not isinstance(value, str):
            raise TypeError(f'str expected, not {type(value).__name__}')
        _launch_engine.set(self._environment, self._key(name), str(value))

    def __delitem__(self, name):
        self[name]
        _launch_engine.erase(self._environment, name)

    def __iter__(self):
        return iter(_launch_engine.names(self._environment) if _launch_engine.is_running() else self._outside())

    def __len__(self):
        return sum(1 for _ in self)

    def __or__(self, other):
        return {**self, **other}

    def __ror__(self, other):
        return {**other, **self}

    def __repr__(self):
        return repr(dict(self))

    def copy(self):
        return dict(self)

    # The values where there is no launch, as in an expression of $(eval).
    def _outside(self):
        return _of_launcher if self._environment else {}

    @staticmethod
    def _key(name):
        if not isinstance(name, str):
            raise TypeError(f'str expected, not {type(name).__name__}')
        return name


environment = LaunchVariables(True)
configurations = LaunchVariables(False)


def replace_os_environ():
    """
    Makes os.environ the launch's environment, which begins as a copy of the launcher's environment.

    `set_env` and the like change it while the launch is visited. The launcher's own environment stays as it is.
    """
    os.environ = environment
