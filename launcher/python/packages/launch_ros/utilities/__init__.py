# SPDX-License-Identifier: Apache-2.0
"""Functions on namespaces, parameters, remappings and node names."""

from launch import _names
from launch._values import pairs
from launch.substitutions import parts_of
from launch_ros.utilities._parameters import (
    evaluate_parameter_dict, evaluate_parameters, normalize_parameter_dict, normalize_parameters)
from launch_ros.utilities.to_parameters_list import to_parameters_list


def is_root_namespace(ns):
    return ns == '/'


def is_namespace_absolute(ns):
    return ns.startswith('/')


def make_namespace_absolute(ns):
    return ns if ns is None or ns.startswith('/') else '/' + ns


def prefix_namespace(base_ns=None, ns=None):
    """The namespace below the base, unless it is absolute; None when neither is given."""
    if ns is None:
        return base_ns
    if not base_ns or ns.startswith('/'):
        combined = ns
    else:
        combined = ('' if base_ns == '/' else base_ns) + '/' + ns
    return combined if combined == '/' else combined.rstrip('/')


def normalize_remap_rule(remap_rule):
    from_, to = pairs([remap_rule], 'remap_rule')[0]
    return parts_of(from_), parts_of(to)


def normalize_remap_rules(remap_rules):
    return [normalize_remap_rule(rule) for rule in remap_rules]


_counts = {}


def add_node_name(context, node_name):
    _counts[node_name] = _counts.get(node_name, 0) + 1


def get_node_name_count(context, node_name):
    """How often add_node_name() was called with this name in this launch."""
    return _counts.get(node_name, 0)


_names.same_module(__name__, *(f'{__name__}.{name}' for name in (
    'namespace_utils', 'normalize_remap_rule', 'track_node_names')))
_names.same_module(__name__ + '._parameters', __name__ + '.normalize_parameters', __name__ + '.evaluate_parameters')
