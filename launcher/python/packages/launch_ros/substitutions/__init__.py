# SPDX-License-Identifier: Apache-2.0
"""Substitutions that know packages and parameters."""

from launch import _names
from launch.substitutions import _Argument, _Builtin, described
from launch.substitutions._joined import ExtendedBySlash


class _OfPackage(ExtendedBySlash, _Builtin):
    """A folder of a package."""

    package = _Argument(0)

    def __init__(self, package):
        self._take(package)

    def describe(self):
        return f'{type(self).__name__}(pkg={described(self._arguments[0])})'

    def find(self, package_name):
        """The folder of any package, at once."""
        from launch.launch_context import LaunchContext
        return LaunchContext._of_launch()._perform(type(self)(package_name))


class ExecutableInPackage(ExtendedBySlash, _Builtin):
    _call = 'exec-in-pkg'
    executable = _Argument(0)
    package = _Argument(1)

    def __init__(self, executable, package):
        self._take(executable, package)

    def describe(self):
        return f'ExecInPkg(pkg={described(self._arguments[1])}, exec={described(self._arguments[0])})'


class FindPackagePrefix(_OfPackage):
    _call = 'find-pkg-prefix'


class FindPackage(FindPackagePrefix):
    pass


class FindPackageShare(_OfPackage):
    _call = 'find-pkg-share'


class Parameter(_Builtin):
    """The value of an earlier SetParameter."""

    _call = 'param'
    name = _Argument(0)

    def __init__(self, name, *, default=None):
        self._take(name, optional=default)


_names.one_class_modules(__name__)
_names.same_module(__name__, __name__ + '.find_package')
