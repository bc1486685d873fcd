# SPDX-License-Identifier: Apache-2.0
"""Substitutions whose text is read as a value of a type."""

from typing import Any, List, get_args, get_origin

from launch._values import text
from launch.substitution import Substitution
from launch.utilities import normalize_to_list_of_substitutions

SomeValueType = Any
NormalizedValueType = Any
AllowedTypesType = Any
AllowedTypesTuple = (bool, int, float, str, List[bool], List[int], List[float], List[str])


def is_typing_list(data_type):
    return data_type is list or get_origin(data_type) is list


def _is_text(value):
    return isinstance(value, (str, Substitution)) or (
        isinstance(value, (list, tuple)) and any(isinstance(part, Substitution) for part in value))


def normalize_typed_substitution(value, data_type=None):
    """Turns a text into a list of substitutions; a value that has its type already stays as it is."""
    if _is_text(value) and not (data_type is not None and is_typing_list(data_type) and isinstance(value, (list, tuple))):
        return normalize_to_list_of_substitutions(value)
    return value


def get_typed_value(value, data_type=None, can_be_str=True):
    """The value of a text by the rules of YAML; raises ValueError when it has another type."""
    import yaml
    if isinstance(value, (list, tuple)):
        inner = (get_args(data_type) or (None,))[0] if data_type is not None else None
        return [get_typed_value(item, inner, can_be_str) for item in value]
    if data_type is str or not isinstance(value, str):
        return value
    found = yaml.safe_load(value)
    if data_type is None:
        return found if can_be_str or not isinstance(found, str) else value
    if data_type is float and isinstance(found, int) and not isinstance(found, bool):
        return float(found)
    wanted = list if is_typing_list(data_type) else data_type
    if not isinstance(found, wanted) or (wanted is int and isinstance(found, bool)):
        raise ValueError(f"'{value}' is no {getattr(data_type, '__name__', data_type)}")
    return found


def perform_typed_substitution(context, value, data_type=None):
    """The value of a result of normalize_typed_substitution()."""
    if isinstance(value, Substitution) or (isinstance(value, list) and value and all(
            isinstance(part, Substitution) for part in value)):
        return get_typed_value(context._perform(text(value, 'value')), data_type)
    if isinstance(value, list):
        return [perform_typed_substitution(context, item, (get_args(data_type) or (None,))[0]) for item in value]
    return value
