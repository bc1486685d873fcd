# SPDX-License-Identifier: Apache-2.0
"""The content of a .msg, .srv or .action file: the parser's result and the emitters' input."""

import re
from dataclasses import dataclass, field
from typing import Any, List, Optional


def snake_case(camel_case: str) -> str:
    """The file name of a type: 'MultiArrayLayout' becomes 'multi_array_layout', as everywhere in ROS 2."""
    words = re.sub(r'(.)([A-Z][a-z]+)', r'\1_\2', camel_case)
    return re.sub(r'([a-z0-9])([A-Z])', r'\1_\2', words).lower()


@dataclass(frozen=True)
class Type:
    """The type of a field's elements, and their number."""

    name: str  # 'int32', 'string', or the name of a message
    package: Optional[str] = None  # set for a message; primitives have none
    string_bound: Optional[int] = None  # maximum length of a string or wstring
    array_size: Optional[int] = None  # N of [N]
    sequence_bound: Optional[int] = None  # N of [<=N]
    is_sequence: bool = False  # [] and [<=N]
    namespace: str = 'msg'  # for a message

    @property
    def is_message(self) -> bool:
        return self.package is not None

    @property
    def is_string(self) -> bool:
        return self.name in ('string', 'wstring') and not self.is_message

    @property
    def is_array(self) -> bool:
        return self.array_size is not None

    @property
    def element(self) -> 'Type':
        return Type(self.name, self.package, self.string_bound, namespace=self.namespace)


@dataclass(frozen=True)
class Field:
    type: Type
    name: str
    default: Any = None  # a Python value, or a list of them for arrays and sequences


@dataclass(frozen=True)
class Constant:
    type: Type
    name: str
    value: Any


# An empty C++ struct and an empty CDR type cause problems, so ROS 2 gives a message without fields this one.
PLACEHOLDER = Field(Type('uint8'), 'structure_needs_at_least_one_member')


@dataclass
class Message:
    package: str
    namespace: str  # 'msg', 'srv' or 'action': the folder of the file
    name: str
    fields: List[Field] = field(default_factory=list)
    constants: List[Constant] = field(default_factory=list)

    @property
    def members(self) -> List[Field]:
        """The fields of the C++ struct and of the bytes. There is always at least one."""
        return self.fields or [PLACEHOLDER]

    @property
    def cpp(self) -> str:
        return f'{self.package}::{self.namespace}::{self.name}'

    @property
    def messages_used(self) -> List[Type]:
        """The distinct messages among the fields' types, in the order of their first use."""
        return list(dict.fromkeys(Type(f.type.name, f.type.package, namespace=f.type.namespace)
                                  for f in self.members if f.type.is_message))


@dataclass
class Service:
    package: str
    namespace: str  # 'srv', or 'action' for the services of an action
    name: str
    request: Message
    response: Message

    @property
    def cpp(self) -> str:
        return f'{self.package}::{self.namespace}::{self.name}'

    @property
    def event(self) -> Message:
        """The message that introspection publishes about a call: with the request or the response, or neither."""
        def at_most_one(message: Message) -> Type:
            return Type(message.name, message.package, sequence_bound=1, is_sequence=True, namespace=message.namespace)

        return Message(self.package, self.namespace, f'{self.name}_Event', [
            Field(Type('ServiceEventInfo', 'service_msgs'), 'info'),
            Field(at_most_one(self.request), 'request'), Field(at_most_one(self.response), 'response')])

    @property
    def messages(self) -> List[Message]:
        return [self.request, self.response, self.event]


@dataclass
class Action:
    """The messages and services of an action extend its name: Fibonacci_Goal, Fibonacci_SendGoal."""

    package: str
    name: str

    namespace = 'action'

    @property
    def cpp(self) -> str:
        return f'{self.package}::{self.namespace}::{self.name}'


@dataclass
class InterfaceFile:
    """One file: its messages and the services and action made of them.

    A .msg file has one message, a .srv file the request, the response and the event of its service. An .action file has
    goal, result and feedback, and the types that carry them: two services and the feedback message.
    """

    package: str
    namespace: str
    name: str
    messages: List[Message]
    services: List[Service] = field(default_factory=list)
    action: Optional[Action] = None
    source: str = ''  # the text of the file
    encoding: str = ''  # 'idl' for the text of an .idl file, otherwise the namespace says it

    @property
    def header(self) -> str:
        return f'{self.package}/{self.namespace}/{snake_case(self.name)}.hpp'

    def detail_header(self, part: str) -> str:
        return f'{self.package}/{self.namespace}/detail/{snake_case(self.name)}__{part}.hpp'

    @property
    def messages_of_others(self) -> List[Type]:
        """The distinct messages from other files among the fields' types, in the order of their first use."""
        own = {(message.package, message.namespace, message.name) for message in self.messages}
        used = [t for message in self.messages for t in message.messages_used]
        return list(dict.fromkeys(t for t in used if (t.package, t.namespace, t.name) not in own))


def action_file(package: str, name: str, goal: Message, result: Message, feedback: Message) -> InterfaceFile:
    """The file of an action, with the services and the message that carry its three parts in ROS 2."""
    goal_id = Field(Type('UUID', 'unique_identifier_msgs'), 'goal_id')

    def part(message: Message) -> Type:
        return Type(message.name, package, namespace='action')

    def make(suffix: str, *fields: Field) -> Message:
        return Message(package, 'action', f'{name}_{suffix}', list(fields))

    send_goal = Service(package, 'action', f'{name}_SendGoal',
                        make('SendGoal_Request', goal_id, Field(part(goal), 'goal')),
                        make('SendGoal_Response', Field(Type('bool'), 'accepted'),
                             Field(Type('Time', 'builtin_interfaces'), 'stamp')))
    get_result = Service(package, 'action', f'{name}_GetResult',
                         make('GetResult_Request', goal_id),
                         make('GetResult_Response', Field(Type('int8'), 'status'), Field(part(result), 'result')))
    feedback_message = make('FeedbackMessage', goal_id, Field(part(feedback), 'feedback'))
    messages = [goal, result, feedback, *send_goal.messages, *get_result.messages, feedback_message]
    return InterfaceFile(package, 'action', name, messages, [send_goal, get_result], Action(package, name))
