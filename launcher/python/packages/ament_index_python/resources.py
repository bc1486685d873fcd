# SPDX-License-Identifier: Apache-2.0
"""The resource index below the prefixes."""

import os

from ament_index_python.search_paths import get_search_paths

class InvalidResourceTypeNameError(ValueError):
    """A type of resources with a slash in its name."""


class InvalidResourceNameError(ValueError):
    """A resource with a slash in its name."""


def _check(resource_type, resource_name=''):
    if '/' in resource_type or '\\' in resource_type:
        raise InvalidResourceTypeNameError(f"Resource type '{resource_type}' contains a slash")
    if '/' in resource_name or '\\' in resource_name:
        raise InvalidResourceNameError(f"Resource name '{resource_name}' contains a slash")


_INDEX = os.path.join('share', 'ament_index', 'resource_index')


def _files(folder):
    return [name for name in os.listdir(folder)
            if not name.startswith('.') and os.path.isfile(os.path.join(folder, name))]


def get_resource_types():
    types = set()
    for prefix in get_search_paths():
        index = os.path.join(prefix, _INDEX)
        if os.path.isdir(index):
            types.update(name for name in os.listdir(index) if os.path.isdir(os.path.join(index, name)))
    return types


def get_resources(resource_type):
    _check(resource_type)
    resources = {}
    for prefix in get_search_paths():
        folder = os.path.join(prefix, _INDEX, resource_type)
        if os.path.isdir(folder):
            for name in _files(folder):
                resources.setdefault(name, prefix)
    return resources


def has_resource(resource_type, resource_name):
    _check(resource_type, resource_name)
    for prefix in get_search_paths():
        if os.path.isfile(os.path.join(prefix, _INDEX, resource_type, resource_name)):
            return prefix
    return False


def get_resource(resource_type, resource_name):
    prefix = has_resource(resource_type, resource_name)
    if not prefix:
        raise LookupError(f"could not find the resource '{resource_name}' of type '{resource_type}'")
    with open(os.path.join(prefix, _INDEX, resource_type, resource_name), encoding='utf-8') as file:
        return file.read(), prefix
