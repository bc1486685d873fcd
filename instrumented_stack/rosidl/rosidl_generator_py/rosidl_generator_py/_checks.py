# SPDX-License-Identifier: Apache-2.0
"""Checks of the values that fields are given: AssertionError, unless Python runs with -O."""

import array
import math
from collections import UserList, UserString
from collections.abc import Sequence, Set
from typing import Any, Callable, List, Optional

from ._field_types import FieldType, numpy

FLOATING_BOUNDS = {'float': 3.402823466e+38, 'double': 1.7976931348623157e+308}
Check = Callable[[Any], None]


def check_of(name: str, type_: FieldType) -> Check:
    """A function that raises AssertionError if a value is none of the field's."""
    return _check_of_many(name, type_) if type_.is_many else _check_of_one(name, type_)


def kept_as_it_is(name: str, type_: FieldType, value: Any) -> bool:
    """Whether the value is an array of the field's own kind, which a message keeps without a copy."""
    if type_.type_code is None:
        return False
    if type_.is_sequence:
        if not isinstance(value, array.array):
            return False
        assert value.typecode == type_.type_code, \
            f"The '{name}' array.array() must have the type code of '{type_.type_code}'"
        assert type_.bound is None or len(value) <= type_.bound, \
            f"The '{name}' array.array() must have a size <= {type_.bound}"
        return True
    if not isinstance(value, numpy().ndarray):
        return False
    assert value.dtype == type_.dtype, f"The '{name}' numpy.ndarray() must have the dtype of 'numpy.{type_.dtype.name}'"
    assert value.size == type_.size, f"The '{name}' numpy.ndarray() must have a size of {type_.size}"
    return True


def _integer_bounds(element: str) -> Optional[range]:
    if not element.lstrip('u').startswith('int'):
        return None
    bits = int(element.lstrip('uint'))
    return range(0, 1 << bits) if element.startswith('u') else range(-(1 << (bits - 1)), 1 << (bits - 1))


def _is_finite_or_inf(value: float, bound: float) -> bool:
    return not (value < -bound or value > bound) or math.isinf(value)


def _python_type(type_: FieldType) -> str:
    if type_.is_message:
        return type_.element.rsplit('/', 1)[1]
    return {'boolean': 'bool', 'octet': 'bytes', 'char': 'str', 'string': 'str', 'wstring': 'str', 'float': 'float',
            'double': 'float'}.get(type_.element, 'int')


def _check_of_one(name: str, type_: FieldType) -> Check:
    field = f"The '{name}' field must be"
    element = type_.element
    if type_.is_message:
        def check(value: Any) -> None:
            assert isinstance(value, type_.message), f"{field} a sub message of type '{_python_type(type_)}'"
    elif type_.string_bound is not None:
        def check(value: Any) -> None:
            assert isinstance(value, (str, UserString)) and len(value) <= type_.string_bound, \
                f'{field} string value not longer than {type_.string_bound}'
    elif element == 'octet':
        def check(value: Any) -> None:
            assert isinstance(value, (bytes, bytearray)) and len(value) == 1, \
                f"{field} of type 'bytes' or 'ByteString' with length 1"
    elif element == 'char':
        def check(value: Any) -> None:
            assert isinstance(value, (str, UserString)) and len(value) == 1 and ord(str(value)) < 128, \
                f"{field} of type 'str' or 'UserString' with length 1 and the character ord() in [-128, 127]"
    elif element in FLOATING_BOUNDS:
        bound = FLOATING_BOUNDS[element]

        def check(value: Any) -> None:
            assert isinstance(value, float), f"{field} of type 'float'"
            assert _is_finite_or_inf(value, bound), f'{field} a {element} in [{-bound}, {bound}]'
    elif element in ('boolean', 'string', 'wstring'):
        expected = bool if element == 'boolean' else str

        def check(value: Any) -> None:
            assert isinstance(value, expected), f"{field} of type '{expected.__name__}'"
    else:
        bounds = _integer_bounds(element)
        assert bounds is not None
        kind = 'an unsigned integer' if element.startswith('u') else 'an integer'

        def check(value: Any) -> None:
            assert isinstance(value, int), f"{field} of type 'int'"
            assert bounds[0] <= value <= bounds[-1], f'{field} {kind} in [{bounds[0]}, {bounds[-1]}]'
    return check


def _check_of_many(name: str, type_: FieldType) -> Check:
    def check(value: Any) -> None:
        assert isinstance(value, (Sequence, Set, UserList)) and not isinstance(value, (str, UserString)) \
            and _has_length(type_, value) and all(map(is_element, value)), \
            f"The '{name}' field must be {_description(type_)}"

    is_element = _element_test(type_)
    return check


def _has_length(type_: FieldType, value: Any) -> bool:
    if type_.size is not None:
        return len(value) == type_.size
    return type_.bound is None or len(value) <= type_.bound


def _element_test(type_: FieldType) -> Callable[[Any], bool]:
    if type_.is_message:
        return lambda value: isinstance(value, type_.message)
    if type_.string_bound is not None:
        bound = type_.string_bound
        return lambda value: isinstance(value, str) and len(value) <= bound
    if type_.element == 'char':
        return lambda value: isinstance(value, str) and 0 <= ord(value) < 256
    if type_.element in FLOATING_BOUNDS:
        limit = FLOATING_BOUNDS[type_.element]
        return lambda value: isinstance(value, float) and _is_finite_or_inf(value, limit)
    integers = _integer_bounds(type_.element)
    if integers is not None:
        low, high = integers[0], integers[-1]
        return lambda value: isinstance(value, int) and low <= value <= high
    expected = {'boolean': bool, 'octet': bytes}.get(type_.element, str)
    return lambda value: isinstance(value, expected)


def _description(type_: FieldType) -> str:
    parts: List[str] = ['a set or sequence']
    if type_.size is not None:
        parts.append(f'with length {type_.size}')
    elif type_.bound is not None:
        parts.append(f'with length <= {type_.bound}')
    if type_.string_bound is not None:
        parts.append(f'and each string value not longer than {type_.string_bound}')
    parts.append(f"and each value of type '{_python_type(type_)}'")
    integers = _integer_bounds(type_.element) if not type_.is_message else None
    if integers is not None:
        kind = 'unsigned integer' if type_.element.startswith('u') else 'integer'
        parts.append(f'and each {kind} in [{integers[0]}, {integers[-1]}]')
    elif type_.element == 'char':
        parts.append('and each char in [0, 255]')
    elif type_.element in FLOATING_BOUNDS:
        bound = FLOATING_BOUNDS[type_.element]
        parts.append(f'and each {type_.element} in [{-bound:f}, {bound:f}]')
    return ' '.join(parts)
