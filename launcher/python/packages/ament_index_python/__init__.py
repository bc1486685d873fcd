# SPDX-License-Identifier: Apache-2.0
"""The packages that the launch sees: AMENT_PREFIX_PATH of its environment, and the launcher's own."""

from ament_index_python import packages, resources, search_paths
from ament_index_python.packages import (
    PackageNotFoundError, get_package_prefix, get_package_share_directory, get_package_share_path,
    get_packages_with_prefixes)
from ament_index_python.resources import (
    InvalidResourceNameError, InvalidResourceTypeNameError, get_resource, get_resource_types, get_resources,
    has_resource)
from ament_index_python.search_paths import get_search_paths

__all__ = ['InvalidResourceNameError', 'InvalidResourceTypeNameError', 'PackageNotFoundError', 'get_package_prefix',
           'get_package_share_directory', 'get_package_share_path', 'get_packages_with_prefixes', 'get_resource',
           'get_resource_types', 'get_resources', 'get_search_paths', 'has_resource', 'packages', 'resources',
           'search_paths']
