# SPDX-License-Identifier: Apache-2.0
"""Parameters of nodes as objects of rclpy. The function needs rclpy, which is no part of the launcher."""

import pathlib
import warnings

from launch_ros.utilities._parameters import evaluate_parameter_dict, normalize_parameter_dict

_KEY = 'ros__parameters'


def _by_node(sections, names=()):
    """The parameters of each node of a parameter file, by its name without a leading slash."""
    found = {}
    for name, value in sections.items():
        if name == _KEY:
            return {'/'.join(names): value}
        if isinstance(value, dict):
            found.update(_by_node(value, (*names, name.lstrip('/'))))
    return found


def _of_file(path, node_name):
    import yaml
    with open(path, encoding='utf-8') as file:
        content = yaml.safe_load(file)
    sections = _by_node(content)
    if not sections:
        return content  # a plain mapping of names to values
    if not node_name:
        warnings.warn('node name not provided to launch; parameter files will not apply', UserWarning, stacklevel=3)
    return {**sections.get('**', {}), **sections.get(node_name, {})}


def to_parameters_list(context, node_name, namespace, evaluated_parameters):
    """What evaluate_parameters() has given, files read for the node, as rclpy.parameter.Parameter."""
    from rclpy.parameter import Parameter
    node_name = node_name.lstrip('/')
    if namespace and namespace != '/':
        node_name = f'{namespace.strip("/")}/{node_name}'
    found = []
    for given in evaluated_parameters:
        if isinstance(given, pathlib.Path):
            given = evaluate_parameter_dict(context, normalize_parameter_dict(_of_file(given, node_name)))
        if not isinstance(given, dict):
            raise RuntimeError(f'invalid evaluated parameters {given!r}')
        for name, value in given.items():
            kind = next((kind for kind in Parameter.Type if kind.check(value)), None)
            if kind is None:
                raise RuntimeError(f'invalid parameter value {value!r}')
            found.append(Parameter(name, kind, value))
    return found
