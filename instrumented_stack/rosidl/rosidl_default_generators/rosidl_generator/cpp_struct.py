# SPDX-License-Identifier: Apache-2.0
"""Emits the structs that users of a message see: msg/<name>.hpp and msg/detail/<name>__struct.hpp."""

from typing import List

from . import cpp_types
from .interface_definition import Action, Constant, Field, InterfaceFile, Message, Type, snake_case


def main_header(file: InterfaceFile) -> str:
    includes = [f'"{file.detail_header(part)}"' for part in ('struct', 'builder', 'traits', 'type_support')]
    return cpp_types.header(file.header, includes, '')


def struct_header(file: InterfaceFile) -> str:
    body = '\n'.join(_struct(message) for message in file.messages)
    for service in file.services:
        name = service.name
        body += (f'\nstruct {name} {{\n  using Request = {name}_Request;\n  using Response = {name}_Response;\n'
                 f'  using Event = {name}_Event;\n}};\n')
    if file.action:
        body += _action(file.action)
    body = cpp_types.namespace_blocks(file.package, file.namespace, body)
    return cpp_types.header(file.detail_header('struct'), _includes(file), body)


def _action(action: Action) -> str:
    name = action.name
    return f'''
struct {name} {{
  using Goal = {name}_Goal;
  using Result = {name}_Result;
  using Feedback = {name}_Feedback;

  /// How the action is carried.
  struct Impl {{
    using SendGoalService = {name}_SendGoal;
    using GetResultService = {name}_GetResult;
    using FeedbackMessage = {name}_FeedbackMessage;
    using CancelGoalService = action_msgs::srv::CancelGoal;
    using GoalStatusMessage = action_msgs::msg::GoalStatusArray;
  }};
}};
'''


def _includes(file: InterfaceFile) -> List[str]:
    members = [member for message in file.messages for member in message.members]
    types = [member.type for member in members]
    used = {'<cstdint>', '<memory>'}
    if any(t.is_array for t in types):
        used |= {'<algorithm>', '<array>'}
    if any(t.is_string for t in types) or any(c.type.is_string for m in file.messages for c in m.constants):
        used.add('<string>')
    if any(t.is_sequence and t.sequence_bound is None for t in types):
        used.add('<vector>')
    if any(_is_unusual_float(c) for m in file.messages for c in m.constants) or any(
            _is_unusual_float(value) for m in members for value in _values(m)):
        used.add('<limits>')
    ours = {'"rosidl_runtime_cpp/message_allocator.hpp"', '"rosidl_runtime_cpp/message_initialization.hpp"'}
    if any(t.sequence_bound is not None for t in types):
        ours.add('"rosidl_runtime_cpp/bounded_vector.hpp"')
    for used_type in file.messages_of_others:
        ours.add(f'"{used_type.package}/msg/detail/{snake_case(used_type.name)}__struct.hpp"')
    if file.action:
        ours |= {'"action_msgs/msg/goal_status_array.hpp"', '"action_msgs/srv/cancel_goal.hpp"'}
    return [*sorted(used), *sorted(ours)]


def _values(member: Field) -> List[object]:
    return member.default if isinstance(member.default, list) else [member.default]


def _is_unusual_float(value: object) -> bool:
    value = value.value if isinstance(value, Constant) else value
    return isinstance(value, float) and value in (float('inf'), float('-inf')) or value != value


def _struct(message: Message) -> str:
    name = message.name
    parts = [_constructor(message), _members(message), _setters(message), _constants(message), _pointers(name),
             _comparison(message)]
    alias = (f'template <class ContainerAllocator>\n'
             f'using {name}_ = rosidl_runtime_cpp::MessageWithAllocator<{name}, ContainerAllocator>;\n')
    return f'struct {name} {{\n' + '\n'.join(part for part in parts if part) + '};\n' + alias


def _constructor(message: Message) -> str:
    """The constructors. rosidl_runtime_cpp::MessageInitialization says which members each argument sets."""
    nested = [m for m in message.members if m.type.is_message and not m.type.is_sequence]
    numbers = [m for m in message.members
               if not m.type.is_message and not m.type.is_sequence and not m.type.is_string]
    defaults = [m for m in message.members if m.default is not None]

    initializers = [f'{m.name}(_init)' for m in nested if not m.type.is_array]
    body = [f'{m.name}.fill({cpp_types.element_type(m.type)}(_init));' for m in nested if m.type.is_array]
    body += _if_any('ALL', 'ZERO', [_zero(m) for m in numbers if m.default is None])
    body += _if_any('ALL', 'DEFAULTS_ONLY', [_assign_default(m) for m in defaults])
    body += _if_any('ZERO', 'ZERO', [_zero(m) for m in numbers if m.default is not None])

    parameter = ' _init' if body or initializers else ''
    kind = 'rosidl_runtime_cpp::MessageInitialization'
    head = f'  explicit {message.name}({kind}{parameter} = {kind}::ALL)'
    if initializers:
        head += '\n      : ' + ', '.join(initializers)
    with_allocator = f'  explicit {message.name}(const std::allocator<void>&, {kind} _init = {kind}::ALL)'
    return (head + (' {\n' + ''.join(f'    {line}\n' for line in body) + '  }\n' if body else ' {}\n') +
            f'{with_allocator} : {message.name}(_init) {{}}\n')


def _if_any(one: str, other: str, statements: List[str]) -> List[str]:
    """The statements, for two of the ways to initialise a message."""
    if not statements:
        return []
    conditions = [f'_init == rosidl_runtime_cpp::MessageInitialization::{way}' for way in dict.fromkeys((one, other))]
    return [f'if ({" || ".join(conditions)}) {{', *(f'  {statement}' for statement in statements), '}']


def _zero(member: Field) -> str:
    zero = {'bool': 'false', 'float32': '0.0f', 'float64': '0.0'}.get(member.type.name, '0')
    return f'{member.name}.fill({zero});' if member.type.is_array else f'{member.name} = {zero};'


def _assign_default(member: Field) -> str:
    if isinstance(member.default, list):
        values = ', '.join(cpp_types.literal(member.type, value) for value in member.default)
        braces = f'{{{{{values}}}}}' if member.type.is_array else f'{{{values}}}'
        return f'{member.name} = {braces};'
    return f'{member.name} = {cpp_types.literal(member.type, member.default)};'


def _members(message: Message) -> str:
    lines: List[str] = []
    for member in message.members:
        lines.append(f'  using _{member.name}_type = {cpp_types.member_type(member.type)};')
        lines.append(f'  _{member.name}_type {member.name};')
    return '\n'.join(lines) + '\n'


def _setters(message: Message) -> str:
    return '\n'.join(
        f'  {message.name}& set__{m.name}(const _{m.name}_type& _arg) {{\n    {m.name} = _arg;\n    return *this;\n  }}'
        for m in message.fields) + ('\n' if message.fields else '')


def _constants(message: Message) -> str:
    lines: List[str] = []
    for constant in message.constants:
        cpp = cpp_types.element_type(constant.type)
        if constant.type.is_string:
            lines.append(f'  static const {cpp} {constant.name};')
        else:
            value = cpp_types.literal(constant.type, constant.value)
            lines.append(f'  static constexpr {cpp} {constant.name} = {value};')
    return '\n'.join(lines) + ('\n' if lines else '')


def constant_definitions(message: Message) -> str:
    """Strings are defined in the package's library; numbers are in the header."""
    return ''.join(f'const {cpp_types.element_type(c.type)} {message.name}::{c.name} = '
                   f'{cpp_types.literal(c.type, c.value)};\n' for c in message.constants if c.type.is_string)


def _pointers(name: str) -> str:
    return f'''  using Type = {name};
  using RawPtr = {name}*;
  using ConstRawPtr = const {name}*;
  using SharedPtr = std::shared_ptr<{name}>;
  using ConstSharedPtr = std::shared_ptr<const {name}>;
  using WeakPtr = std::weak_ptr<{name}>;
  using ConstWeakPtr = std::weak_ptr<const {name}>;
  template <typename Deleter = std::default_delete<{name}>>
  using UniquePtrWithDeleter = std::unique_ptr<{name}, Deleter>;
  using UniquePtr = UniquePtrWithDeleter<>;
  template <typename Deleter = std::default_delete<{name}>>
  using ConstUniquePtrWithDeleter = std::unique_ptr<const {name}, Deleter>;
  using ConstUniquePtr = ConstUniquePtrWithDeleter<>;
'''


def _comparison(message: Message) -> str:
    # A field may be called `other`, but no field begins with an underscore.
    equal = ' &&\n           '.join(f'{m.name} == _other.{m.name}' for m in message.members)
    return f'''  bool operator==(const {message.name}& _other) const {{
    return {equal};
  }}
  bool operator!=(const {message.name}& _other) const {{ return !(*this == _other); }}
'''
