# SPDX-License-Identifier: Apache-2.0
"""Spells types, values and names of interfaces in C++."""

from typing import Any, Iterable, List

from .interface_definition import Type

PRIMITIVES = {'bool': 'bool', 'byte': 'unsigned char', 'char': 'unsigned char', 'idl_char': 'unsigned char',
              'float32': 'float', 'float64': 'double',
              'string': 'std::string', 'wstring': 'std::u16string',
              **{f'{sign}int{bits}': f'{sign}int{bits}_t' for sign in ('', 'u') for bits in (8, 16, 32, 64)}}


def element_type(type_: Type) -> str:
    return f'{type_.package}::{type_.namespace}::{type_.name}' if type_.is_message else PRIMITIVES[type_.name]


def member_type(type_: Type) -> str:
    element = element_type(type_)
    if type_.is_array:
        return f'std::array<{element}, {type_.array_size}>'
    if type_.sequence_bound is not None:
        return f'rosidl_runtime_cpp::BoundedVector<{element}, {type_.sequence_bound}>'
    if type_.is_sequence:
        return f'std::vector<{element}>'
    return element


def literal(type_: Type, value: Any) -> str:
    """One value as a C++ expression."""
    if type_.is_string:
        return string_literal(value, wide=type_.name == 'wstring')
    if type_.name == 'bool':
        return 'true' if value else 'false'
    if type_.name in ('float32', 'float64'):
        return _floating_literal(PRIMITIVES[type_.name], value)
    if type_.name == 'int64':
        # The smallest integer has no literal in C++.
        return '(-9223372036854775807LL - 1)' if value == -(1 << 63) else f'{value}LL'
    if type_.name == 'int32' and value == -(1 << 31):
        return '(-2147483647 - 1)'
    suffix = {'uint64': 'ULL', 'uint32': 'u', 'uint16': 'u', 'uint8': 'u', 'byte': 'u', 'char': 'u',
              'idl_char': 'u'}
    return f'{value}{suffix.get(type_.name, "")}'


def _floating_literal(cpp: str, value: float) -> str:
    if value != value:
        return f'std::numeric_limits<{cpp}>::quiet_NaN()'
    if value in (float('inf'), float('-inf')):
        return f'{"-" if value < 0 else ""}std::numeric_limits<{cpp}>::infinity()'
    return f'{value!r}{"f" if cpp == "float" else ""}'


def string_literal(text: str, wide: bool = False) -> str:
    """A literal in plain ASCII. Octal escapes end after three digits; hexadecimal ones would have no end."""
    if wide:
        units = text.encode('utf-16-le')
        codes: Iterable[int] = (units[i] | units[i + 1] << 8 for i in range(0, len(units), 2))
        # A universal character name cannot be a surrogate or a basic character, so the literal is split.
        return ' '.join(_wide_parts(codes)) or 'u""'
    return '"' + ''.join(_escaped(byte) for byte in text.encode()) + '"'


def _escaped(byte: int) -> str:
    return chr(byte) if 32 <= byte < 127 and chr(byte) not in '"\\?' else f'\\{byte:03o}'


def _wide_parts(codes: Iterable[int]) -> List[str]:
    parts: List[str] = []
    for code in codes:
        parts.append(f'u"{_escaped(code)}"' if code < 128 else f'u"\\x{code:x}"')
    return parts


def namespace_blocks(package: str, namespace: str, body: str) -> str:
    return f'namespace {package}::{namespace} {{\n\n{body}\n}}  // namespace {package}::{namespace}\n'


LICENSE_LINE = '// SPDX-License-Identifier: Apache-2.0'


def header(path: str, includes: Iterable[str], body: str) -> str:
    """A complete header: guard, includes, body."""
    guard = path.upper().replace('/', '__').replace('.', '_') + '_'
    lines = '\n'.join(f'#include {include}' for include in includes)
    return f'{LICENSE_LINE}\n#ifndef {guard}\n#define {guard}\n\n{lines}\n\n{body}\n#endif  // {guard}\n'
