# SPDX-License-Identifier: Apache-2.0
"""Functions on namespaces."""

from launch import _names


def is_root_namespace(namespace):
    return namespace == '/'


def is_namespace_absolute(namespace):
    return namespace.startswith('/')


def make_namespace_absolute(namespace):
    return namespace if namespace.startswith('/') else '/' + namespace


def prefix_namespace(base_namespace=None, namespace=None):
    """The namespace below the base, unless it is absolute; None when neither is given."""
    if namespace is None:
        return base_namespace
    if not base_namespace or namespace.startswith('/'):
        combined = namespace
    else:
        combined = base_namespace.rstrip('/') + '/' + namespace
    return combined if combined == '/' else combined.rstrip('/')


_names.same_module(__name__, __name__ + '.namespace_utils')
