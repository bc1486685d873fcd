# SPDX-License-Identifier: Apache-2.0
"""Emits the traits that templates need of a type: msg/detail/<name>__traits.hpp and <name>__type_support.hpp."""

from typing import List

from . import cpp_types
from .interface_definition import Field, InterfaceFile, Message


def traits_header(file: InterfaceFile) -> str:
    printing = '\n'.join(_printing_declarations(message) for message in file.messages)
    traits = '\n'.join(_message_traits(message) for message in file.messages)
    for service in file.services:
        traits += '\n' + _names(service) + f'''
template <>
struct is_service<{service.cpp}> : std::true_type {{}};
template <>
struct is_service_request<{service.request.cpp}> : std::true_type {{}};
template <>
struct is_service_response<{service.response.cpp}> : std::true_type {{}};
'''
    if file.action:
        name = file.action.cpp
        traits += '\n' + _names(file.action) + f'''
template <>
struct is_action<{name}> : std::true_type {{}};
template <>
struct is_action_goal<{name}_Goal> : std::true_type {{}};
template <>
struct is_action_result<{name}_Result> : std::true_type {{}};
template <>
struct is_action_feedback<{name}_Feedback> : std::true_type {{}};
'''
    body = (cpp_types.namespace_blocks(file.package, file.namespace, printing)
            + f'\nnamespace rosidl_generator_traits {{\n\n{traits}\n}}  // namespace rosidl_generator_traits\n')
    includes = ['<cstddef>', '<iosfwd>', '<string>', f'"{file.detail_header("struct")}"']
    includes += sorted(f'"{InterfaceFile(str(t.package), "msg", t.name, []).detail_header("traits")}"'
                       for t in file.messages_of_others)
    return cpp_types.header(file.detail_header('traits'), [*includes, '"rosidl_runtime_cpp/traits.hpp"'], body)


def _printing_declarations(message: Message) -> str:
    return f'''/// As YAML, a member per line.
void to_block_style_yaml(const {message.name}& message, std::ostream& out, std::size_t indentation = 0);
/// As YAML within one line.
void to_flow_style_yaml(const {message.name}& message, std::ostream& out);
std::string to_yaml(const {message.name}& message, bool use_flow_style = false);
'''


def _names(type_) -> str:
    return f'''template <>
inline const char* data_type<{type_.cpp}>() {{
  return "{type_.cpp}";
}}
template <>
inline const char* name<{type_.cpp}>() {{
  return "{type_.cpp.replace('::', '/')}";
}}
'''


def _message_traits(message: Message) -> str:
    return _names(message) + f'''template <>
struct is_message<{message.cpp}> : std::true_type {{}};
template <>
struct has_fixed_size<{message.cpp}> : std::bool_constant<{_all(message, 'has_fixed_size')}> {{}};
template <>
struct has_bounded_size<{message.cpp}> : std::bool_constant<{_all(message, 'has_bounded_size')}> {{}};
'''


def _all(message: Message, trait: str) -> str:
    conditions: List[str] = []
    for member in message.members:
        if not _may_have(trait, member):
            return 'false'
        if member.type.is_message:
            conditions.append(f'{trait}<{cpp_types.element_type(member.type)}>::value')
    return ' && '.join(dict.fromkeys(conditions)) or 'true'


def _may_have(trait: str, member: Field) -> bool:
    if trait == 'has_fixed_size':
        return not member.type.is_string and not member.type.is_sequence
    return ((not member.type.is_string or member.type.string_bound is not None)
            and (not member.type.is_sequence or member.type.sequence_bound is not None))


def type_support_header(file: InterfaceFile) -> str:
    handles = ''.join(f'''template <>
const rosidl_message_type_support_t* get_message_type_support_handle<{message.cpp}>();
''' for message in file.messages)
    includes = [f'"{file.detail_header("struct")}"', '"rosidl_typesupport_cpp/message_type_support.hpp"']
    handles += ''.join(f'''template <>
const rosidl_service_type_support_t* get_service_type_support_handle<{service.cpp}>();
''' for service in file.services)
    if file.services:
        includes.append('"rosidl_typesupport_cpp/service_type_support.hpp"')
    if file.action:
        handles += f'''template <>
const rosidl_action_type_support_t* get_action_type_support_handle<{file.action.cpp}>();
'''
        includes.append('"rosidl_typesupport_cpp/action_type_support.hpp"')
    body = f'namespace rosidl_typesupport_cpp {{\n\n{handles}\n}}  // namespace rosidl_typesupport_cpp\n'
    return cpp_types.header(file.detail_header('type_support'), includes, body)
