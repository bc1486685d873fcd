# SPDX-License-Identifier: Apache-2.0
"""Emits a message's builder, pkg::build<pkg::msg::Name>().x(1).y(2): msg/detail/<name>__builder.hpp."""

from typing import List

from . import cpp_types
from .interface_definition import InterfaceFile, Message


def builder_header(file: InterfaceFile) -> str:
    steps = '\n'.join(_steps(message) for message in file.messages)
    starts = '\n'.join(_start(message) for message in file.messages)
    body = cpp_types.namespace_blocks(file.package, f'{file.namespace}::builder', steps)
    body += f'''
namespace {file.package} {{

template <typename MessageType>
auto build();

{starts}
}}  // namespace {file.package}
'''
    return cpp_types.header(file.detail_header('builder'), ['<utility>', f'"{file.detail_header("struct")}"'], body)


def _steps(message: Message) -> str:
    """A class for each field. Its function sets the field and returns the next class, at the end the message."""
    classes: List[str] = []
    following = f'::{message.cpp}'
    for field in reversed(message.fields):
        name = _step(message, field.name)
        classes.append(f'''class {name} {{
 public:
  explicit {name}(::{message.cpp} _message) : message_(std::move(_message)) {{}}
  {following} {field.name}(::{message.cpp}::_{field.name}_type _arg) {{
    message_.{field.name} = std::move(_arg);
    return {following}(std::move(message_));
  }}

 private:
  ::{message.cpp} message_;
}};
''')
        following = name
    return '\n'.join(classes)


def _start(message: Message) -> str:
    first = f'{message.namespace}::builder::{_step(message, message.fields[0].name)}(' if message.fields else ''
    return f'''template <>
inline auto build<::{message.cpp}>() {{
  return {first}::{message.cpp}(){')' if first else ''};
}}
'''


def _step(message: Message, field: str) -> str:
    return f'Init_{message.name}_{field}'
