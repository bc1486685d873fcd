# SPDX-License-Identifier: Apache-2.0
"""Spells types and names of interfaces in C."""

from typing import Any, Union

from . import cpp_types
from .interface_definition import Action, Message, Service, Type

# The names that rosidl_runtime_c gives sequences are those of IDL.
SEQUENCES = {'bool': 'boolean', 'byte': 'octet', 'char': 'uint8', 'idl_char': 'char', 'float32': 'float',
             'float64': 'double', 'string': 'String', 'wstring': 'U16String'}
PRIMITIVES = {'bool': 'bool', 'byte': 'uint8_t', 'char': 'uint8_t', 'idl_char': 'signed char', 'float32': 'float',
              'float64': 'double', 'string': 'rosidl_runtime_c__String', 'wstring': 'rosidl_runtime_c__U16String',
              **{f'{sign}int{bits}': f'{sign}int{bits}_t' for sign in ('', 'u') for bits in (8, 16, 32, 64)}}


def name(interface: Union[Message, Service, Action]) -> str:
    """std_msgs__msg__String"""
    return f'{interface.package}__{interface.namespace}__{interface.name}'


def element_type(type_: Type) -> str:
    return f'{type_.package}__{type_.namespace}__{type_.name}' if type_.is_message else PRIMITIVES[type_.name]


def sequence_type(type_: Type) -> str:
    if type_.is_message:
        return f'{element_type(type_)}__Sequence'
    return f'rosidl_runtime_c__{SEQUENCES.get(type_.name, type_.name)}__Sequence'


def declaration(type_: Type, member: str) -> str:
    if type_.is_sequence:
        return f'{sequence_type(type_)} {member}'
    return f'{element_type(type_)} {member}' + (f'[{type_.array_size}]' if type_.is_array else '')


def floating_literal(type_: Type, value: float) -> str:
    if value != value:
        return 'NAN'
    if value in (float('inf'), float('-inf')):
        return 'INFINITY' if value > 0 else '-INFINITY'
    return cpp_types.literal(type_, value)


def fits_int(value: Any) -> bool:
    """Enumerators of C are int."""
    return -(1 << 31) <= value < 1 << 31
