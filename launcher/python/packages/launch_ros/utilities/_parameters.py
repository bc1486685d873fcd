# SPDX-License-Identifier: Apache-2.0
"""The `parameters` of nodes in the forms that ROS 2's package hands on: normalised, and evaluated."""

from collections.abc import Mapping, Sequence

from launch._values import WrongKind, name_of, text
from launch.substitution import Substitution
from launch.substitutions import parts_of
from launch.utilities.type_utils import is_substitution, perform_typed_substitution
from launch_ros.parameter_descriptions import Parameter, ParameterFile, ParameterValue


def normalize_parameters(parameters):
    """Files, mappings and Parameter objects, with lists of substitutions for texts."""
    if isinstance(parameters, (str, bytes)) or not isinstance(parameters, Sequence):
        raise WrongKind(f'parameters must be a list, got {name_of(parameters)}', 'put it in [ ]')
    return [given if isinstance(given, (Parameter, ParameterFile)) else
            normalize_parameter_dict(given) if isinstance(given, Mapping) else ParameterFile(given)
            for given in parameters]


def normalize_parameter_dict(parameters, *, _prefix=()):
    """Names as tuples of substitutions; nested mappings become names with dots."""
    found = {}
    for name, value in parameters.items():
        name = (*_prefix, *parts_of(text(name, 'the name of a parameter')))
        if isinstance(value, Mapping):
            found.update(normalize_parameter_dict(value, _prefix=(*name, *parts_of(('.',)))))
        else:
            found[name] = _normalized(value)
    return found


def _normalized(value):
    if isinstance(value, (bool, int, float, ParameterValue)):
        return value
    if isinstance(value, str) or is_substitution(value):
        return tuple(parts_of(text(value, 'a parameter')))
    return tuple(tuple(parts_of(text(item, 'a parameter'))) if isinstance(item, (str, Substitution)) else item
                 for item in value)


def evaluate_parameters(context, parameters):
    """Mappings of names to values, paths of files, and Parameter objects."""
    from pathlib import Path
    found = []
    for given in parameters:
        if isinstance(given, Mapping):
            found.append(evaluate_parameter_dict(context, given))
        elif isinstance(given, ParameterFile):
            found.append(given.evaluate(context))
        elif isinstance(given, Parameter):
            given.evaluate(context)
            found.append(given)
        else:
            found.append(Path(context._perform(text(given, 'a parameter file'))))
    return tuple(found)


def evaluate_parameter_dict(context, parameters):
    return {context._perform(text(name, 'the name of a parameter')): _evaluated(context, value)
            for name, value in parameters.items()}


def _evaluated(context, value):
    from launch.substitutions import TextSubstitution
    if isinstance(value, ParameterValue):
        return value.evaluate(context)
    if not isinstance(value, (tuple, list)):
        return value
    if value and all(isinstance(part, Substitution) for part in value):
        if all(isinstance(part, TextSubstitution) for part in value):
            return ''.join(part.perform(context) for part in value)  # a text stays one
        return perform_typed_substitution(context, list(value))
    return tuple(_evaluated(context, item) for item in value)
