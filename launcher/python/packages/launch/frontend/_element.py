# SPDX-License-Identifier: Apache-2.0
"""An element of a file that the launcher reads, for the class of a package that makes an action of it."""

from launch._values import LaunchFileError
from launch.frontend._parser import Entity
from launch.utilities.type_utils import coerce_to_type, extract_type, is_instance_of


class Element(Entity):
    """Remembers which attributes and children were asked for: what is left over is an error, as in ROS 2."""

    def __init__(self, type_name, place, attributes, children, number, is_item):
        super().__init__(type_name, {name: _Untyped(value) if untyped else value
                                     for name, value, _place, _name_place, untyped in attributes},
                         [Element(*child) for child in children])
        self.place = place
        self.number = number  # the launcher keeps the element under this number
        self._places = {name: where for name, _value, where, *_ in attributes}
        self._name_places = {name: where for name, _value, _place, where, _untyped in attributes}
        self._is_item = is_item
        self._asked = set()
        self._children_asked = False

    @property
    def children(self):
        self._children_asked = True
        return [child for child in self._children if not child._is_item]

    def get_attr(self, name, *, data_type=str, optional=False, can_be_str=True):
        self._asked.add(name)
        if 'Entity' in str(data_type):
            found = [child for child in self._children if child.type_name == name]
            if found or optional:
                return found or None
            raise LaunchFileError(f"nested tag '{name}' not found in entity '{self.type_name}'", '', self.place)
        if name not in self._attributes:
            if optional:
                return None
            raise LaunchFileError(f"attribute '{name}' not found in entity '{self.type_name}'", '', self.place)
        value = self._attributes[name]
        try:
            found = self._as_type(name, value, data_type, can_be_str)
            return Placed(found, self._places[name]) if isinstance(found, str) else found
        except (TypeError, ValueError) as error:
            raise LaunchFileError(f"attribute '{name}' of '{self.type_name}': {error}", '', self._places[name]) from None

    def _as_type(self, name, value, data_type, can_be_str):
        separator = self._attributes.get(f'{name}-sep')
        if separator is not None and isinstance(value, str):
            self._asked.add(f'{name}-sep')
            return [coerce_to_type(part, None if data_type is None else extract_type(data_type)[0],
                                   can_be_str=can_be_str) for part in value.split(separator)]
        if isinstance(value, _Untyped):
            return str(value) if data_type is str else coerce_to_type(str(value), data_type, can_be_str=can_be_str)
        if not is_instance_of(value, data_type, can_be_str=can_be_str):
            expected = getattr(data_type, '__name__', str(data_type))
            raise ValueError(f'expected to be of type {expected}, got {type(value).__name__}')
        return value

    def assert_entity_completely_parsed(self):
        known = sorted(self._asked)
        for name, place in self._name_places.items():
            if name not in self._asked:
                raise LaunchFileError(f"unexpected attribute '{name}' in '{self.type_name}'", _near(name, known), place)
        for child in self._children:
            if child.type_name not in self._asked and not (self._children_asked and not child._is_item):
                raise LaunchFileError(f"unexpected nested tag '{child.type_name}' in '{self.type_name}'",
                                      _near(child.type_name, known), child.place)


class Placed(str):
    """The text of an attribute that knows its place."""

    def __new__(cls, text, place):
        self = super().__new__(cls, text)
        self.place = place
        return self


class _Untyped(str):
    """The text of an attribute of XML, which has no type of its own."""


def _near(name, known):
    import difflib
    near = difflib.get_close_matches(name, known, 1)
    return f"did you mean '{near[0]}'?" if near else ''
