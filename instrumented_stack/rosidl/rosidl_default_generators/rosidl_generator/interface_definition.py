"""What a .msg or .srv file says: the parser's result and the emitters' input."""

import re
from dataclasses import dataclass, field
from typing import Any, List, Optional


def snake_case(camel_case: str) -> str:
    """Name of the files of a type: 'MultiArrayLayout' gives 'multi_array_layout', as everywhere in ROS 2."""
    words = re.sub(r'(.)([A-Z][a-z]+)', r'\1_\2', camel_case)
    return re.sub(r'([a-z0-9])([A-Z])', r'\1_\2', words).lower()


@dataclass(frozen=True)
class Type:
    """One element of a field, and how many of it there are."""

    name: str  # 'int32', 'string', or the name of a message
    package: Optional[str] = None  # of a message; primitives have none
    string_bound: Optional[int] = None  # most characters of a string or wstring
    array_size: Optional[int] = None  # N of [N]
    sequence_bound: Optional[int] = None  # N of [<=N]
    is_sequence: bool = False  # [] and [<=N]

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
        return Type(self.name, self.package, self.string_bound)


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


# An empty C++ struct and an empty CDR type are both awkward, so ROS 2 gives a message without fields this one.
PLACEHOLDER = Field(Type('uint8'), 'structure_needs_at_least_one_member')


@dataclass
class Message:
    package: str
    namespace: str  # 'msg' or 'srv': the folder of the file
    name: str
    fields: List[Field] = field(default_factory=list)
    constants: List[Constant] = field(default_factory=list)

    @property
    def members(self) -> List[Field]:
        """The fields that the C++ struct and the bytes have: never none."""
        return self.fields or [PLACEHOLDER]

    @property
    def cpp(self) -> str:
        return f'{self.package}::{self.namespace}::{self.name}'


@dataclass
class Service:
    package: str
    name: str
    request: Message
    response: Message

    namespace = 'srv'

    @property
    def cpp(self) -> str:
        return f'{self.package}::{self.namespace}::{self.name}'


@dataclass
class InterfaceFile:
    """One file: its messages (one, or the request and response of its service)."""

    package: str
    namespace: str
    name: str
    messages: List[Message]
    service: Optional[Service] = None

    @property
    def header(self) -> str:
        return f'{self.package}/{self.namespace}/{snake_case(self.name)}.hpp'

    def detail_header(self, part: str) -> str:
        return f'{self.package}/{self.namespace}/detail/{snake_case(self.name)}__{part}.hpp'
