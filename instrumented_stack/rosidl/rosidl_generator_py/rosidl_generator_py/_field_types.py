# SPDX-License-Identifier: Apache-2.0
"""The types of fields, read from their text: 'int32', 'string<8>', 'std_msgs/msg/Header', 'sequence<double, 3>', 'float[9]'."""

import array
import functools
import re
from importlib import import_module
from typing import Any, Callable, Optional

from rosidl_parser import definition

TYPE_CODES = {'float': 'f', 'double': 'd', 'int8': 'b', 'uint8': 'B', 'int16': 'h', 'uint16': 'H', 'int32': 'i',
              'uint32': 'I', 'int64': 'q', 'uint64': 'Q'}
_TEXT = re.compile(r'(?:sequence<)?(?P<element>w?string(?:<\d+>)?|[\w/]+)(?:, (?P<bound>\d+))?>?(?:\[(?P<size>\d+)\])?')


class FieldType:
    """What the values of a field are, and what is there without a value."""

    def __init__(self, text: str):
        match = _TEXT.fullmatch(text)
        assert match, text
        self.is_sequence = text.startswith('sequence<')
        self.size = int(match['size']) if match['size'] else None
        self.bound = int(match['bound']) if match['bound'] else None
        self.element = match['element']
        self.string_bound = None
        if '<' in self.element:
            self.element, bound = self.element[:-1].split('<')
            self.string_bound = int(bound)
        self.is_message = '/' in self.element
        # Of arrays of numbers, otherwise None.
        self.type_code = TYPE_CODES.get(self.element) if self.is_many else None
        # As in the table of fields of a class, where messages have no 'msg'.
        self.text = text
        if self.is_message:
            package, _, name = self.element.split('/')
            self.text = text.replace(self.element, f'{package}/{name}')

    @property
    def is_many(self) -> bool:
        return self.is_sequence or self.size is not None

    @property
    def dtype(self) -> Any:
        """Of numpy arrays."""
        return numpy().dtype(self.type_code)

    @functools.cached_property
    def message(self) -> Any:
        """The class of the messages in the field."""
        return class_of(self.element)

    def slot_type(self) -> definition.AbstractType:
        """The type in the form that rosidl_parser gives it."""
        element: Any
        if self.is_message:
            *namespaces, name = self.element.split('/')
            element = definition.NamespacedType(namespaces, name)
        elif self.element.endswith('string'):
            kinds = {('string', False): definition.UnboundedString, ('string', True): definition.BoundedString,
                     ('wstring', False): definition.UnboundedWString, ('wstring', True): definition.BoundedWString}
            kind: Any = kinds[self.element, self.string_bound is not None]
            element = kind(self.string_bound) if self.string_bound is not None else kind()
        else:
            element = definition.BasicType(self.element)
        if self.size is not None:
            return definition.Array(element, self.size)
        if self.bound is not None:
            return definition.BoundedSequence(element, self.bound)
        return definition.UnboundedSequence(element) if self.is_sequence else element

    def convert(self, value: Any) -> Any:
        """The object that a message keeps for a value."""
        if self.type_code is None:
            return value
        return array.array(self.type_code, value) if self.is_sequence else numpy().array(value, dtype=self.dtype)

    def default(self, given: Any = None) -> Callable[[], Any]:
        """A function that makes the value of a new message. `given` is the default of the definition."""
        if given is not None:
            if self.type_code is not None:
                return lambda: self.convert(given)
            return (lambda: list(given)) if self.is_many else (lambda: given)
        if self.is_sequence:
            return functools.partial(array.array, self.type_code) if self.type_code else list
        if self.type_code is not None:
            return lambda: numpy().zeros(self.size, dtype=self.dtype)
        one = self._one()
        if self.size is not None:
            size = self.size
            return lambda: [one() for _ in range(size)]
        return one

    def _one(self) -> Callable[[], Any]:
        if self.is_message:
            return lambda: self.message()
        return {'boolean': bool, 'float': float, 'double': float, 'string': str, 'wstring': str, 'octet': lambda: b'\0',
                'char': lambda: '\0'}.get(self.element, int)


@functools.lru_cache(maxsize=None)
def field_type(text: str) -> FieldType:
    """Fields of the same type share it."""
    return FieldType(text)


def class_of(type_name: str) -> Any:
    """The class of std_msgs/msg/Header, or of any other message, service or action."""
    package, namespace, name = type_name.split('/')
    return getattr(import_module(f'{package}.{namespace}'), name)


_numpy: Optional[Any] = None


def numpy() -> Any:
    """The module numpy, which only messages with arrays of numbers need."""
    global _numpy
    if _numpy is None:
        try:
            _numpy = import_module('numpy')
        except ModuleNotFoundError as error:
            raise ImportError('arrays of numbers in messages need numpy (Debian: python3-numpy)', name='numpy') from error
    return _numpy
