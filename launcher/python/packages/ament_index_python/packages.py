# SPDX-License-Identifier: Apache-2.0
"""Packages, as $(find-pkg-prefix …) and $(find-pkg-share …) find them."""

import os

from ament_index_python.resources import get_resources


class PackageNotFoundError(KeyError):
    """No package of that name. If it is not caught, it ends the launch with the launcher's own message."""

    def __str__(self):
        return str(self.args[0])


def _find(substitution, package_name):
    from launch.launch_context import LaunchContext
    from launch.substitutions import SubstitutionFailure
    try:
        return LaunchContext._of_launch()._perform(substitution(package_name))
    except SubstitutionFailure as failure:
        error = PackageNotFoundError(str(failure))
        error._number = failure._number
        raise error from None


def get_package_prefix(package_name):
    from launch_ros.substitutions import FindPackagePrefix
    return _find(FindPackagePrefix, package_name)


def get_package_share_directory(package_name, print_warning=True):
    from launch_ros.substitutions import FindPackageShare
    return _find(FindPackageShare, package_name)


def get_package_share_path(package_name, print_warning=True):
    import pathlib
    return pathlib.Path(get_package_share_directory(package_name))


def get_packages_with_prefixes():
    return get_resources('packages') if os.environ.get('AMENT_PREFIX_PATH') else {}
