# SPDX-License-Identifier: Apache-2.0
"""Emits the headers of C messages: msg/<name>.h and its parts msg/detail/<name>__struct.h, __functions.h and
__type_support.h."""

from typing import List

from . import c_types, cpp_types
from .interface_definition import Constant, InterfaceFile, Message, snake_case


def main_header(file: InterfaceFile) -> str:
    includes = [f'"{detail_path(file, part)}"' for part in ('struct', 'functions', 'type_support')]
    return cpp_types.header(main_path(file), includes, '')


def main_path(file: InterfaceFile) -> str:
    return f'{file.package}/{file.namespace}/{snake_case(file.name)}.h'


def detail_path(file: InterfaceFile, part: str) -> str:
    return f'{file.package}/{file.namespace}/detail/{snake_case(file.name)}__{part}.h'


def struct_header(file: InterfaceFile) -> str:
    members = [member.type for message in file.messages for member in message.members]
    constants = [constant for message in file.messages for constant in message.constants]
    used = {'<stdbool.h>', '<stddef.h>', '<stdint.h>'}
    if any(_is_float(c) and c_types.floating_literal(c.type, c.value)[-1] in 'NY' for c in constants):
        used.add('<math.h>')
    ours = {f'"{t.package}/msg/detail/{snake_case(t.name)}__struct.h"' for t in file.messages_of_others}
    if any(t.is_sequence and not t.is_message and not t.is_string for t in members):
        ours.add('"rosidl_runtime_c/primitives_sequence.h"')
    ours |= {f'"rosidl_runtime_c/{"string" if t.name == "string" else "u16string"}.h"' for t in members if t.is_string}
    body = '\n'.join(_struct(message) for message in file.messages)
    return cpp_types.header(detail_path(file, 'struct'), [*sorted(used), *sorted(ours)], body)


def _struct(message: Message) -> str:
    name = c_types.name(message)
    constants = ''.join(_constant(name, constant) for constant in message.constants)
    bounds = ''.join(_bound(f'{name}__{m.name}__MAX_SIZE', m.type.sequence_bound)
                     + _bound(f'{name}__{m.name}__MAX_STRING_SIZE', m.type.string_bound) for m in message.members)
    members = ''.join(f'  {c_types.declaration(m.type, m.name)};\n' for m in message.members)
    return f'''{constants}{bounds}typedef struct {name} {{
{members}}} {name};

typedef struct {name}__Sequence {{
  {name}* data;
  size_t size;
  size_t capacity;
}} {name}__Sequence;
'''


def _is_float(constant: Constant) -> bool:
    return constant.type.name in ('float32', 'float64')


def _constant(prefix: str, constant: Constant) -> str:
    name = f'{prefix}__{constant.name}'
    if constant.type.name == 'string':
        return f'static const char* const {name} = {cpp_types.string_literal(constant.value)};\n'
    if constant.type.name == 'wstring':
        units = constant.value.encode('utf-16-le')
        values = ', '.join(str(units[i] | units[i + 1] << 8) for i in range(0, len(units), 2))
        return f'static const uint16_t {name}[] = {{{values}{", " if values else ""}0}};\n'
    if _is_float(constant):
        return (f'static const {c_types.element_type(constant.type)} {name} = '
                f'{c_types.floating_literal(constant.type, constant.value)};\n')
    if constant.type.name == 'bool':
        return f'static const bool {name} = {"true" if constant.value else "false"};\n'
    if c_types.fits_int(constant.value):
        return f'enum {{ {name} = {cpp_types.literal(constant.type, constant.value).rstrip("uUL")} }};\n'
    return f'#define {name} {cpp_types.literal(constant.type, constant.value)}\n'


def _bound(name: str, bound: object) -> str:
    return f'enum {{ {name} = {bound} }};\n' if bound is not None else ''


def functions_header(file: InterfaceFile) -> str:
    body = _extern_c('\n'.join(_functions(c_types.name(message)) for message in file.messages))
    return cpp_types.header(detail_path(file, 'functions'),
                            ['<stdbool.h>', '<stddef.h>', f'"{detail_path(file, "struct")}"',
                             '"rosidl_runtime_c/message_type_support_struct.h"', '"rosidl_runtime_c/type_hash.h"'], body)


def _functions(name: str) -> str:
    sequence = f'{name}__Sequence'
    return f'''// {name}: a message must be initialised before it is used, also as the output of a copy. Functions that return
// bool or a pointer return false or null for a null pointer, or if memory runs out.
bool {name}__init({name}* msg);
void {name}__fini({name}* msg);
{name}* {name}__create(void);
void {name}__destroy({name}* msg);
bool {name}__are_equal(const {name}* lhs, const {name}* rhs);
bool {name}__copy(const {name}* input, {name}* output);
bool {sequence}__init({sequence}* array, size_t size);
void {sequence}__fini({sequence}* array);
{sequence}* {sequence}__create(size_t size);
void {sequence}__destroy({sequence}* array);
bool {sequence}__are_equal(const {sequence}* lhs, const {sequence}* rhs);
bool {sequence}__copy(const {sequence}* input, {sequence}* output);
// The argument is not used, and may be null.
const rosidl_type_hash_t* {name}__get_type_hash(const rosidl_message_type_support_t* type_support);
'''


def type_support_header(file: InterfaceFile) -> str:
    includes = ['"rosidl_runtime_c/get_type_support.h"', '"rosidl_runtime_c/message_type_support_struct.h"']
    lines: List[str] = []
    for message in file.messages:
        lines.append(_getter('message', message))
    if file.services:
        includes.append('"rosidl_runtime_c/service_type_support_struct.h"')
    for service in file.services:
        lines.append(_getter('service', service))
    if file.action:
        includes.append('"rosidl_runtime_c/action_type_support_struct.h"')
        lines.append(_getter('action', file.action))
    return cpp_types.header(detail_path(file, 'type_support'), includes, _extern_c(''.join(lines)))


def _getter(kind: str, interface: object) -> str:
    return (f'const rosidl_{kind}_type_support_t* rosidl_typesupport_c__get_{kind}_type_support_handle__'
            f'{c_types.name(interface)}(void);\n')  # type: ignore[arg-type]


def _extern_c(text: str) -> str:
    return f'#ifdef __cplusplus\nextern "C" {{\n#endif\n\n{text}\n#ifdef __cplusplus\n}}\n#endif\n'
