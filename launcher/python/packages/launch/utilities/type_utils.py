# SPDX-License-Identifier: Apache-2.0
"""Values with types: what a text gives by the rules of YAML, and values that hold substitutions."""

from collections.abc import Iterable

from launch._values import text
from launch.substitution import Substitution
from launch.utilities import ensure_argument_type, normalize_to_list_of_substitutions, perform_substitutions

ScalarTypesTuple = (int, float, bool, str)
ListTypesTuple = (list[int], list[float], list[bool], list[str])
AllowedTypesTuple = ScalarTypesTuple + ListTypesTuple
# Type hints.
AllowedTypesType = AllowedValueType = ScalarTypesType = ScalarValueType = ListTypesType = ListValueType = object
SequenceValueType = SomeScalarType = SomeSequenceType = SomeValueType = object
NormalizedScalarType = NormalizedSequenceType = NormalizedValueType = object
StrSomeScalarType = StrSomeSequenceType = StrSomeValueType = object


def is_typing_list(data_type):
    return data_type is list or getattr(data_type, '__origin__', None) is list  # so have List and List[int]


def is_valid_scalar_type(data_type):
    return data_type in ScalarTypesTuple


def extract_type(data_type):
    """(type of the scalar or of the items, whether it is a list); ValueError for any other type."""
    inner = getattr(data_type, '__args__', ()) if is_typing_list(data_type) else ()
    scalar = inner[0] if inner else data_type
    if not is_valid_scalar_type(scalar):
        raise ValueError(f'Unrecognized data type: {data_type}')
    return scalar, bool(inner)


def is_instance_of_valid_type(value, *, can_be_str=False):
    """A scalar, or a list of scalars of one type."""
    if not isinstance(value, list):
        return isinstance(value, ScalarTypesTuple)
    kind = next((type(item) for item in value if type(item) is not str), str)
    return not value or (kind in ScalarTypesTuple and
                         all(isinstance(item, (kind, str) if can_be_str else kind) for item in value))


def is_instance_of(value, data_type=None, *, can_be_str=False):
    if data_type is None:
        return is_instance_of_valid_type(value, can_be_str=can_be_str)
    scalar, is_list = extract_type(data_type)
    kinds = (scalar, str) if can_be_str else scalar
    if not is_list:
        return isinstance(value, kinds)
    return isinstance(value, list) and all(isinstance(item, kinds) for item in value)


def _as_yaml(value, problem, can_be_str):
    import yaml
    if not value:
        return value
    try:
        found = yaml.safe_load(value)
    except Exception as error:
        if can_be_str:
            return value
        raise ValueError(f'{problem}: yaml.safe_load() failed\n{error}') from error
    if not is_instance_of_valid_type(found, can_be_str=can_be_str):
        raise ValueError(f'{problem}: output type is not allowed, got {type(found)}')
    return found


def coerce_to_type(value, data_type=None, *, can_be_str=False):
    """The value that a str gives as this type; ValueError when it has another type."""
    ensure_argument_type(value, str, 'value', 'coerce_to_type')
    if data_type is None:
        return _as_yaml(value, f"Failed to convert '{value}' using yaml rules", can_be_str)
    scalar, is_list = extract_type(data_type)
    kinds = (scalar, str) if can_be_str else scalar
    problem = f"Cannot convert value '{value}' to {'a list of ' if is_list else ''}'{scalar.__name__}'"
    if is_list:
        found = _as_yaml(value, problem, can_be_str)
        if not isinstance(found, list) or not all(isinstance(item, kinds) for item in found):
            raise ValueError(f'{problem}, got {found}')
        return found
    if scalar is str:
        return value
    if scalar is not bool:
        try:
            return scalar(value)
        except ValueError:
            if can_be_str:
                return value
            raise
    found = _as_yaml({'1': 'true', '0': 'false'}.get(value, value), problem, can_be_str)
    if not isinstance(found, kinds):
        raise ValueError(problem)
    return found


def coerce_list(value, data_type=None, *, can_be_str=False):
    ensure_argument_type(value, list, 'value', 'coerce_list')
    found = [coerce_to_type(item, data_type, can_be_str=can_be_str) for item in value]
    if not is_instance_of_valid_type(found, can_be_str=can_be_str):
        raise ValueError(f'cannot convert value to {data_type}. Got value=`{value}`')
    return found


def get_typed_value(value, data_type=None, *, can_be_str=False):
    """The value of a str, or the values of a list of str."""
    if not isinstance(value, list):
        return coerce_to_type(value, data_type, can_be_str=can_be_str)
    if data_type is not None:
        data_type, is_list = extract_type(data_type)
        if not is_list:
            raise TypeError(f"Cannot convert input '{value}' of type '{type(value)}' to '{data_type}'")
    return coerce_list(value, data_type, can_be_str=can_be_str)


def is_substitution(x):
    """A substitution, or a list of texts and at least one substitution, which are pasted together."""
    if isinstance(x, Substitution):
        return True
    return (isinstance(x, (list, tuple)) and any(isinstance(item, Substitution) for item in x) and
            all(isinstance(item, (Substitution, str)) for item in x))


is_text = is_substitution


def is_normalized_substitution(x):
    return isinstance(x, list) and bool(x) and all(isinstance(item, Substitution) for item in x)


def normalize_typed_substitution(value, data_type=None):
    """The value, with a list of substitutions for each text that holds some; TypeError for another type."""
    if isinstance(value, ScalarTypesTuple):
        if not is_instance_of(value, data_type):
            raise TypeError(f"value='{value}' is not an instance of {data_type}")
        return value
    if is_substitution(value):
        return normalize_to_list_of_substitutions(value)
    if not isinstance(value, Iterable):
        raise TypeError('value should be either a scalar, a substitutions, or a mixed list of scalars and '
                        f'substitutions. Got `value={value}` of type `{type(value)}`. ')
    is_list = True
    if data_type is not None:
        data_type, is_list = extract_type(data_type)
    if not is_list:
        raise TypeError('The provided value resolves to a list, though the required type is a scalar. '
                        f"Got value='{value}', data_type='{data_type}'.")
    items = [item if isinstance(item, ScalarTypesTuple) else normalize_typed_substitution(item) for item in value]
    kinds = {type(item) for item in items if isinstance(item, ScalarTypesTuple)}
    if kinds == {int, float}:
        kinds = {float}
    if len(kinds) > 1 or (kinds and data_type not in (None, *kinds)):
        raise TypeError(f"Got a list of '{kinds}', expected a list of '{data_type}'. value='{value}'")
    return items


def perform_typed_substitution(context, value, data_type=None):
    """The value of a result of normalize_typed_substitution()."""
    if is_normalized_substitution(value) or isinstance(value, Substitution):
        return coerce_to_type(context._perform(text(value, 'value')), data_type)
    if not isinstance(value, list):
        return value
    inner = extract_type(data_type)[0] if data_type is not None else None
    found = [coerce_to_type(perform_substitutions(context, item), inner) if is_normalized_substitution(item) else item
             for item in value]
    if not is_instance_of_valid_type(found):
        raise ValueError(f'The output list is not uniform: {found}')
    return found
