# SPDX-License-Identifier: Apache-2.0
"""Emits the one source file of a package's library, and the header that other packages' libraries need from it.

There is one file for all types, because most of its compile time goes into headers that every type needs.
"""

from typing import Iterable, List, Mapping

from . import cpp_descriptions, cpp_types
from .cpp_struct import constant_definitions
from .interface_definition import InterfaceFile, Message
from .type_hash import Description


def codec_header_path(package: str) -> str:
    return f'{package}/detail/cdr_codecs.hpp'


def codec_header(package: str, files: List[InterfaceFile], least_sizes: Mapping[str, int]) -> str:
    """Declares the conversion of the package's messages to bytes. Needs no definition of any message."""
    messages = [message for file in files for message in file.messages]
    forward = '\n'.join(cpp_types.namespace_blocks(package, namespace, ''.join(
        f'struct {m.name};\n' for m in messages if m.namespace == namespace)) for namespace in _namespaces(messages))
    codecs = '\n'.join(f'''template <>
struct CdrCodec<{m.cpp}> {{
  static void write(eprosima::fastcdr::Cdr& cdr, const {m.cpp}& message);
  static void read(eprosima::fastcdr::Cdr& cdr, {m.cpp}& message);
  static std::size_t end_after(const {m.cpp}& message, std::size_t position);
  static void add_to(MaxSize& size);
  static constexpr std::size_t least_size = {least_sizes[f'{m.package}/{m.namespace}/{m.name}']};
}};
''' for m in messages)
    body = (f'{forward}\nnamespace rosidl_typesupport_fastrtps_cpp {{\n\n{codecs}\n'
            '}  // namespace rosidl_typesupport_fastrtps_cpp\n')
    return cpp_types.header(codec_header_path(package), ['"rosidl_typesupport_fastrtps_cpp/cdr_codec.hpp"'], body)


def _namespaces(messages: Iterable[Message]) -> List[str]:
    return sorted({m.namespace for m in messages})


def source(package: str, files: List[InterfaceFile], descriptions: List[Description],
           hashes: Mapping[str, str]) -> str:
    messages = [message for file in files for message in file.messages]
    packages = {package} | {str(t.package) for m in messages for t in m.messages_used}
    includes = [*(f'#include "{file.header}"' for file in files),
                *(f'#include "{codec_header_path(p)}"' for p in sorted(packages)),
                '#include "rosidl_runtime_cpp/yaml.hpp"',
                '#include "rosidl_typesupport_fastrtps_cpp/type_support.hpp"']
    parts = ['\n'.join([cpp_types.LICENSE_LINE, *includes]) + '\n']
    for namespace in _namespaces(messages):
        parts.append(cpp_types.namespace_blocks(package, namespace, '\n'.join(
            constant_definitions(m) + _printing(m) for m in messages if m.namespace == namespace)))
    parts.append('namespace rosidl_typesupport_fastrtps_cpp {\n\n' + '\n'.join(_codec(m) for m in messages)
                 + '\n}  // namespace rosidl_typesupport_fastrtps_cpp\n')
    parts.append(cpp_descriptions.definitions(files, descriptions, hashes))
    parts.append('namespace rosidl_typesupport_cpp {\n\n' + '\n'.join(_handles(file) for file in files)
                 + '\n}  // namespace rosidl_typesupport_cpp\n')
    return '\n'.join(parts)


def _printing(message: Message) -> str:
    block = '\n'.join(f'  rosidl_runtime_cpp::yaml::write_member(out, "{m.name}", message.{m.name}, indentation);'
                      for m in message.fields)
    flow = '\n'.join(f'  rosidl_runtime_cpp::yaml::write_flow_member(out, {"true" if i == 0 else "false"}, '
                     f'"{m.name}", message.{m.name});' for i, m in enumerate(message.fields))
    unused = '' if message.fields else '[[maybe_unused]] '
    block = block or "  out << std::string(indentation, ' ') << \"{}\\n\";"
    parameters = f'{unused}const {message.name}& message, std::ostream& out'
    return f'''void to_block_style_yaml({parameters}, std::size_t indentation) {{
{block}
}}
void to_flow_style_yaml({parameters}) {{
  out << '{{';
{flow}
  out << '}}';
}}
std::string to_yaml(const {message.name}& message, bool use_flow_style) {{
  return rosidl_runtime_cpp::yaml::to_string(message, use_flow_style);
}}
'''


def _codec(message: Message) -> str:
    cpp = message.cpp
    write = ''.join(f'  cdr_write(cdr, message.{m.name});\n' for m in message.members)
    read = ''.join(f'  cdr_read(cdr, message.{m.name});\n' for m in message.members)
    size = ''.join(f'  position = cdr_end_after(message.{m.name}, position);\n' for m in message.members)
    bounds = ''.join(f'  size.add<{cpp_types.member_type(m.type)}>('
                     f'{m.type.string_bound if m.type.string_bound is not None else ""});\n' for m in message.members)
    last = message.members[-1].name
    return f'''void CdrCodec<{cpp}>::write(eprosima::fastcdr::Cdr& cdr, const {cpp}& message) {{
{write}}}
void CdrCodec<{cpp}>::read(eprosima::fastcdr::Cdr& cdr, {cpp}& message) {{
{read}}}
std::size_t CdrCodec<{cpp}>::end_after(const {cpp}& message, std::size_t position) {{
{size}  return position;
}}
void CdrCodec<{cpp}>::add_to(MaxSize& size) {{
  const std::size_t begin = size.end;
{bounds}  size.plain = size.plain && size.end - begin == offsetof({cpp}, {last}) + sizeof({cpp}::{last});
}}
'''


def _handles(file: InterfaceFile) -> str:
    text = ''.join(f'''template <>
const rosidl_message_type_support_t* get_message_type_support_handle<{m.cpp}>() {{
  return rosidl_typesupport_fastrtps_cpp::message_type_support<{m.cpp}>(
      "{m.package}::{m.namespace}", "{m.name}", {cpp_descriptions.symbol(m)});
}}
''' for m in file.messages)
    text += ''.join(f'''template <>
const rosidl_service_type_support_t* get_service_type_support_handle<{s.cpp}>() {{
  return rosidl_typesupport_fastrtps_cpp::service_type_support<{s.cpp}>(
      "{s.package}::{s.namespace}", "{s.name}", {cpp_descriptions.symbol(s)});
}}
''' for s in file.services)
    if file.action:
        text += f'''template <>
const rosidl_action_type_support_t* get_action_type_support_handle<{file.action.cpp}>() {{
  return action_type_support<{file.action.cpp}>(&{cpp_descriptions.symbol(file.action)});
}}
'''
    return text
