# SPDX-License-Identifier: Apache-2.0
"""Filters of output that know what a middleware prints."""

from ament_index_python import get_resource, has_resource
from launch_testing import tools

_KINDS = ('prefixes', 'patterns')


def get_rmw_output_filter(rmw_implementation, filter_type):
    """The `filter_type` ('prefixes' or 'patterns') that a package has registered for the output of a middleware."""
    if filter_type not in _KINDS:
        raise TypeError(f'Unsupported filter_type "{filter_type}". Supported types: {list(_KINDS)}')
    kind = f'rmw_output_{filter_type}'
    if not has_resource(kind, rmw_implementation):
        return []
    return get_resource(kind, rmw_implementation)[0].splitlines()


def basic_output_filter(filtered_prefixes=None, filtered_patterns=None, filtered_rmw_implementation=None):
    """A function that removes lines with these prefixes or patterns, and those of the middleware of this name."""
    prefixes = list(tools.get_default_filtered_prefixes() if filtered_prefixes is None else filtered_prefixes)
    patterns = list(tools.get_default_filtered_patterns() if filtered_patterns is None else filtered_patterns)
    if filtered_rmw_implementation:
        prefixes += get_rmw_output_filter(filtered_rmw_implementation, 'prefixes')
        patterns += get_rmw_output_filter(filtered_rmw_implementation, 'patterns')
    return tools.basic_output_filter(prefixes, patterns)
