# SPDX-License-Identifier: Apache-2.0
"""The types that fields of interfaces can have, with the names of ROS 2. SLOT_TYPES of each class of messages has these."""

from typing import Any, List, Sequence, Tuple

SIGNED_NONEXPLICIT_INTEGER_TYPES = ('short', 'long', 'long long')
UNSIGNED_NONEXPLICIT_INTEGER_TYPES = ('unsigned short', 'unsigned long', 'unsigned long long')
NONEXPLICIT_INTEGER_TYPES = (*SIGNED_NONEXPLICIT_INTEGER_TYPES, *UNSIGNED_NONEXPLICIT_INTEGER_TYPES)
FLOATING_POINT_TYPES = ('float', 'double', 'long double')
CHARACTER_TYPES = ('char', 'wchar')
BOOLEAN_TYPE = 'boolean'
OCTET_TYPE = 'octet'
SIGNED_EXPLICIT_INTEGER_TYPES = ('int8', 'int16', 'int32', 'int64')
UNSIGNED_EXPLICIT_INTEGER_TYPES = ('uint8', 'uint16', 'uint32', 'uint64')
EXPLICIT_INTEGER_TYPES = (*SIGNED_EXPLICIT_INTEGER_TYPES, *UNSIGNED_EXPLICIT_INTEGER_TYPES)
SIGNED_INTEGER_TYPES = (*SIGNED_NONEXPLICIT_INTEGER_TYPES, *SIGNED_EXPLICIT_INTEGER_TYPES)
UNSIGNED_INTEGER_TYPES = (*UNSIGNED_NONEXPLICIT_INTEGER_TYPES, *UNSIGNED_EXPLICIT_INTEGER_TYPES)
INTEGER_TYPES = (*SIGNED_INTEGER_TYPES, *UNSIGNED_INTEGER_TYPES)
BASIC_TYPES = (*INTEGER_TYPES, *FLOATING_POINT_TYPES, *CHARACTER_TYPES, BOOLEAN_TYPE, OCTET_TYPE)

EMPTY_STRUCTURE_REQUIRED_MEMBER_NAME = 'structure_needs_at_least_one_member'
CONSTANT_MODULE_SUFFIX = '_Constants'
SERVICE_REQUEST_MESSAGE_SUFFIX = '_Request'
SERVICE_RESPONSE_MESSAGE_SUFFIX = '_Response'
SERVICE_EVENT_MESSAGE_SUFFIX = '_Event'
ACTION_GOAL_SUFFIX = '_Goal'
ACTION_RESULT_SUFFIX = '_Result'
ACTION_FEEDBACK_SUFFIX = '_Feedback'
ACTION_GOAL_SERVICE_SUFFIX = '_SendGoal'
ACTION_RESULT_SERVICE_SUFFIX = '_GetResult'
ACTION_FEEDBACK_MESSAGE_SUFFIX = '_FeedbackMessage'


class AbstractType:
    """Any type. Two are equal if they are of the same class and have the same values."""

    __slots__: Tuple[str, ...] = ()

    def _values(self) -> List[Any]:
        return [getattr(self, slot) for class_ in type(self).__mro__ for slot in getattr(class_, '__slots__', ())]

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and self._values() == other._values()  # type: ignore[attr-defined]

    def __hash__(self) -> int:
        return hash(repr(self))

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(map(repr, self._values()))})"


class AbstractNestableType(AbstractType):
    """A type that elements of arrays and sequences can have."""

    __slots__ = ()


class BasicType(AbstractNestableType):
    """A number, a character, a truth value or a byte, by the name of IDL."""

    __slots__ = ('typename',)

    def __init__(self, typename: str):
        assert typename in BASIC_TYPES, f"'{typename}' is not a basic type"
        self.typename = typename


class NamedType(AbstractNestableType):
    """A type by its name alone."""

    __slots__ = ('name',)

    def __init__(self, name: str):
        self.name = name


class NamespacedType(AbstractNestableType):
    """A message: ['std_msgs', 'msg'] and 'Header'."""

    __slots__ = ('namespaces', 'name')

    def __init__(self, namespaces: Sequence[str], name: str):
        self.namespaces = list(namespaces)
        self.name = name

    def namespaced_name(self) -> Tuple[str, ...]:
        """('std_msgs', 'msg', 'Header')"""
        return (*self.namespaces, self.name)


class AbstractGenericString(AbstractNestableType):
    """Any string."""

    __slots__ = ()

    def has_maximum_size(self) -> bool:
        return hasattr(self, 'maximum_size')


class AbstractString(AbstractGenericString):
    """A string of 8-bit characters."""

    __slots__ = ()


class AbstractWString(AbstractGenericString):
    """A string of 16-bit characters."""

    __slots__ = ()


class BoundedString(AbstractString):
    """A string of at most `maximum_size` characters."""

    __slots__ = ('maximum_size',)

    def __init__(self, maximum_size: int):
        assert maximum_size >= 0
        self.maximum_size = maximum_size


class UnboundedString(AbstractString):
    """A string of any length."""

    __slots__ = ()


class BoundedWString(AbstractWString):
    """A string of at most `maximum_size` characters of 16 bits."""

    __slots__ = ('maximum_size',)

    def __init__(self, maximum_size: int):
        assert maximum_size >= 0
        self.maximum_size = maximum_size


class UnboundedWString(AbstractWString):
    """A string of 16-bit characters of any length."""

    __slots__ = ()


class AbstractNestedType(AbstractType):
    """Many elements."""

    __slots__ = ('value_type',)

    def __init__(self, value_type: AbstractNestableType):
        assert isinstance(value_type, AbstractNestableType)
        self.value_type = value_type

    def has_maximum_size(self) -> bool:
        """Whether there is a largest number of elements."""
        raise NotImplementedError


class Array(AbstractNestedType):
    """`size` elements."""

    __slots__ = ('size',)

    def __init__(self, value_type: AbstractNestableType, size: int):
        super().__init__(value_type)
        assert size > 0
        self.size = size

    def has_maximum_size(self) -> bool:
        return True


class AbstractSequence(AbstractNestedType):
    """As many elements as there are."""

    __slots__ = ()


class BoundedSequence(AbstractSequence):
    """At most `maximum_size` elements."""

    __slots__ = ('maximum_size',)

    def __init__(self, value_type: AbstractNestableType, maximum_size: int):
        super().__init__(value_type)
        assert maximum_size > 0
        self.maximum_size = maximum_size

    def has_maximum_size(self) -> bool:
        return True


class UnboundedSequence(AbstractSequence):
    """Any number of elements."""

    __slots__ = ()

    def has_maximum_size(self) -> bool:
        return False
