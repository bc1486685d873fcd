# SPDX-License-Identifier: Apache-2.0
"""Substitutions that know packages and parameters."""

from launch import _names
from launch.substitutions import _Builtin


class ExecutableInPackage(_Builtin):
    _call = 'exec-in-pkg'

    def __init__(self, executable, package):
        self._take(executable, package)


class FindPackagePrefix(_Builtin):
    _call = 'find-pkg-prefix'

    def __init__(self, package):
        self._take(package)


class FindPackage(FindPackagePrefix):
    pass


class FindPackageShare(_Builtin):
    _call = 'find-pkg-share'

    def __init__(self, package):
        self._take(package)


class Parameter(_Builtin):
    """The value of an earlier SetParameter."""

    _call = 'param'

    def __init__(self, name, *, default=None):
        self._take(name, optional=default)


_names.one_class_modules(__name__)
_names.same_module(__name__, __name__ + '.find_package')
