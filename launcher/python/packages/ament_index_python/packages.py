# SPDX-License-Identifier: Apache-2.0
"""Packages, as $(find-pkg-prefix …) and $(find-pkg-share …) find them."""

import os
import sys
import warnings

from ament_index_python.resources import get_resources, has_resource
from ament_index_python.search_paths import get_search_paths


class PackageNotFoundError(KeyError):
    """No package of that name. If it is not caught, it ends the launch with the launcher's own message."""

    def __str__(self):
        return str(self.args[0])


def _launch_runs():
    """Whether the launcher is to be asked, on the thread of the launch. Its environment may be another one."""
    if '_launch_engine' not in sys.modules and '_launch_engine' not in sys.builtin_module_names:
        return False  # a program that has not imported `launch`
    import _launch_engine
    return _launch_engine.is_running()


def _find(substitution, package_name):
    from launch.launch_context import LaunchContext
    from launch.substitutions import SubstitutionFailure
    try:
        return LaunchContext._of_launch()._perform(substitution(package_name))
    except SubstitutionFailure as failure:
        error = PackageNotFoundError(str(failure))
        error._number = failure._number
        raise error from None


def _find_in_index(package_name):
    if not package_name or not isinstance(package_name, str):
        raise ValueError(f"'{package_name}' is not the name of a package")
    try:
        prefix = has_resource('packages', package_name)
    except OSError:  # nothing is sourced: this installation has packages, too
        prefix = os.path.abspath(os.path.join(os.path.dirname(__file__), *4 * ['..']))
        if not os.path.isfile(os.path.join(prefix, 'share/ament_index/resource_index/packages', package_name)):
            raise PackageNotFoundError(f"package '{package_name}' not found, searching: {[prefix]}") from None
    if not prefix:
        raise PackageNotFoundError(f"package '{package_name}' not found, searching: {get_search_paths()}")
    return prefix


def get_package_prefix(package_name):
    if not _launch_runs():
        return _find_in_index(package_name)
    from launch_ros.substitutions import FindPackagePrefix
    return _find(FindPackagePrefix, package_name)


def get_package_share_directory(package_name, print_warning=True):
    if not _launch_runs():
        path = os.path.join(_find_in_index(package_name), 'share', package_name)
        if print_warning and not os.path.isdir(path):
            warnings.warn(f"Share directory for {package_name} ({path}) does not exist.", stacklevel=2)
        return path
    from launch_ros.substitutions import FindPackageShare
    return _find(FindPackageShare, package_name)


def get_package_share_path(package_name, print_warning=True):
    import pathlib
    return pathlib.Path(get_package_share_directory(package_name))


def get_packages_with_prefixes():
    return get_resources('packages') if os.environ.get('AMENT_PREFIX_PATH') else {}
