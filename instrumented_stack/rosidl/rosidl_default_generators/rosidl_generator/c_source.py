# SPDX-License-Identifier: Apache-2.0
"""Emits the source file of a package's library for C: the layouts of its messages.

It is C++ that defines functions of C. The descriptions of the types are in the package's other library.
"""

from typing import List, Mapping

from . import c_headers, c_types, cpp_descriptions, cpp_types
from .interface_definition import Field, InterfaceFile, Message, Type


def source(package: str, files: List[InterfaceFile], least_sizes: Mapping[str, int], hashes: Mapping[str, str]) -> str:
    messages = [message for file in files for message in file.messages]
    types = [field.type for message in messages for field in message.fields if field.default is not None]
    includes = [*(f'#include "{c_headers.main_path(file)}"' for file in files), '#include <limits>']
    if any(file.action for file in files):
        includes += ['#include "action_msgs/msg/goal_status_array.h"', '#include "action_msgs/srv/cancel_goal.h"']
    if types:
        includes += ['#include "rosidl_runtime_c/primitives_sequence_functions.h"',
                     '#include "rosidl_runtime_c/string_functions.h"',
                     '#include "rosidl_runtime_c/u16string_functions.h"']
    includes.append('#include "rosidl_typesupport_c/type_support.hpp"')

    used = sorted({c_types.name(message) for message in messages}
                  | {c_types.element_type(t) for message in messages for t in message.messages_used})
    described = sorted(cpp_descriptions.symbol(interface) for file in files
                       for interface in (*file.messages, *file.services, *([file.action] if file.action else [])))
    declarations = ''.join(f'extern const rosidl_type_description_t {name};\n' for name in described)
    declarations += ''.join(f'extern const rosidl_typesupport_c__MessageLayout {name}__layout;\n' for name in used)
    body = '\n'.join(_message(message, least_sizes) + _type_hash(message, hashes) for message in messages)
    for file in files:
        body += ''.join(f'ROSIDL_TYPESUPPORT_C__DEFINE_SERVICE({c_types.name(s)}, {s.package}, {s.namespace}, {s.name})\n'
                        for s in file.services)
    for file in files:
        if file.action:
            body += (f'ROSIDL_TYPESUPPORT_C__DEFINE_ACTION({c_types.name(file.action)}, {package}, '
                     f'{file.action.name})\n')
    return (f'{cpp_types.LICENSE_LINE}\n' + '\n'.join(includes)
            + f'\n\nextern "C" {{\n\n{declarations}\n{body}\n}}  // extern "C"\n')


def _message(message: Message, least_sizes: Mapping[str, int]) -> str:
    name = c_types.name(message)
    defaults = [field for field in message.fields if field.default is not None]
    text = _set_defaults(name, defaults) if defaults else ''
    offsets = ', '.join(f'offsetof({name}, {m.name})' for m in message.members)
    nested = ', '.join(f'&{c_types.element_type(m.type)}__layout' if m.type.is_message else 'nullptr'
                       for m in message.members)
    least = least_sizes[f'{message.package}/{message.namespace}/{message.name}']
    return text + f'''static const size_t {name}__offsets[] = {{{offsets}}};
static const rosidl_typesupport_c__MessageLayout* const {name}__nested[] = {{{nested}}};
const rosidl_typesupport_c__MessageLayout {name}__layout{{
    &{cpp_descriptions.symbol(message)}, sizeof({name}), {least}, {name}__offsets, {name}__nested,
    {f'{name}__set_defaults' if defaults else 'nullptr'}}};
ROSIDL_TYPESUPPORT_C__DEFINE_MESSAGE({name}, {message.package}, {message.namespace}, {message.name})
'''


def _type_hash(message: Message, hashes: Mapping[str, str]) -> str:
    name = c_types.name(message)
    version, digits = hashes[f'{message.package}/{message.namespace}/{message.name}'].removeprefix('RIHS').split('_')
    octets = ', '.join(f'0x{digits[i:i + 2]}' for i in range(0, len(digits), 2))
    return f'''const rosidl_type_hash_t* {name}__get_type_hash(const rosidl_message_type_support_t*) {{
  static const rosidl_type_hash_t kHash{{{int(version)}, {{{octets}}}}};
  return &kHash;
}}
'''


def _set_defaults(name: str, fields: List[Field]) -> str:
    statements = ''.join(f'  {line}\n' for field in fields for line in _assignments(field))
    return (f'static bool {name}__set_defaults(void* untyped) {{\n  auto& message = *static_cast<{name}*>(untyped);\n'
            f'{statements}  return true;\n}}\n')


def _assignments(field: Field) -> List[str]:
    type_, target = field.type, f'message.{field.name}'
    if type_.is_array:
        return [_assignment(type_, f'{target}[{i}]', value) for i, value in enumerate(field.default)]
    if type_.is_sequence:
        sequence = c_types.sequence_type(type_)
        init = _or_return(f'{sequence}__init(&{target}, {len(field.default)})')
        return [init, *(_assignment(type_, f'{target}.data[{i}]', value) for i, value in enumerate(field.default))]
    return [_assignment(type_, target, field.default)]


def _assignment(type_: Type, target: str, value: object) -> str:
    literal = cpp_types.literal(type_, value)
    if type_.name == 'string':
        return _or_return(f'rosidl_runtime_c__String__assignn(&{target}, {literal}, {len(str(value).encode())})')
    if type_.name == 'wstring':
        return _or_return(f'rosidl_runtime_c__U16String__assignn(&{target}, reinterpret_cast<const uint16_t*>({literal}), '
                          f'{len(str(value).encode("utf-16-le")) // 2})')
    return f'{target} = {literal};'


def _or_return(call: str) -> str:
    return f'if (!{call}) return false;'
