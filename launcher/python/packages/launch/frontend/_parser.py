# SPDX-License-Identifier: Apache-2.0
"""XML and YAML files as ROS 2's package hands them to Python: entities, and a parser that makes descriptions."""

import io
import os

from launch.launch_description_sources import InvalidLaunchFileError


class InvalidFrontendLaunchFileError(InvalidLaunchFileError):
    pass


class Entity:
    """An element of XML or a mapping of YAML: its name, its parent, its children and its attributes."""

    def __init__(self, type_name, attributes, children, parent=None):
        self._type_name = type_name
        self._attributes = attributes
        self._children = children
        self._parent = parent
        for child in children:
            child._parent = self

    @property
    def type_name(self):
        return self._type_name

    @property
    def parent(self):
        return self._parent

    @property
    def children(self):
        return self._children

    def get_attr(self, name, *, data_type=str, optional=False, can_be_str=True):
        """The value of an attribute, or the children of this name if data_type is a list of entities."""
        from launch.utilities.type_utils import coerce_to_type
        children = [child for child in self._children if child.type_name == name]
        if children and 'Entity' in str(data_type):
            return children
        if name not in self._attributes:
            if optional:
                return None
            raise AttributeError(f"Attribute '{name}' of type '{data_type}' not found in Entity '{self._type_name}'")
        value = self._attributes[name]
        return value if not isinstance(value, str) or data_type is str else coerce_to_type(
            value, data_type, can_be_str=can_be_str)

    def assert_entity_completely_parsed(self):
        """The launcher checks its files itself."""


def _of_xml(element):
    return Entity(element.tag, dict(element.attrib), [_of_xml(child) for child in element])


def _of_yaml(name, value):
    given = value if isinstance(value, dict) else {'children': value or []}
    children = [_of_yaml(*next(iter(child.items()))) for child in given.get('children', [])]
    attributes = {}
    for key, content in given.items():
        if isinstance(content, list) and content and all(isinstance(item, dict) for item in content):
            children += [] if key == 'children' else [_of_yaml(key, item) for item in content]
        elif key != 'children':
            attributes[key] = content
    return Entity(name, attributes, children)


class Parser:
    """Reads launch files of XML and YAML."""

    def __init__(self, path=None):
        self._path = path

    @classmethod
    def load(cls, file):
        """(the root entity, a parser for it) of a path or of an open file."""
        import xml.etree.ElementTree
        opened = isinstance(file, (str, bytes, os.PathLike))
        text = open(file, encoding='utf-8').read() if opened else file.read()
        path = os.fspath(file) if opened else getattr(file, 'name', None)
        try:
            return _of_xml(xml.etree.ElementTree.parse(io.StringIO(text)).getroot()), cls(path)
        except xml.etree.ElementTree.ParseError as problem:
            import yaml
            try:
                content = yaml.safe_load(text)
            except yaml.YAMLError:
                content = None
            if not isinstance(content, dict) or len(content) != 1:
                raise InvalidFrontendLaunchFileError(f'{path}: {problem}') from None
            return _of_yaml(*next(iter(content.items()))), cls(path)

    @classmethod
    def load_launch_extensions(cls):
        """The launcher's own files need none."""

    load_parser_implementations = load_launch_extensions

    @classmethod
    def get_file_extensions(cls):
        return {'xml', 'yaml', 'yml'}

    get_available_extensions = get_file_extensions

    @classmethod
    def may_parse(cls, filename):
        return filename.rpartition('.')[2] in cls.get_file_extensions()

    is_filename_valid = may_parse

    def parse_substitution(self, value):
        from launch.frontend.parse_substitution import parse_substitution
        return parse_substitution(value)

    def parse_if_substitutions(self, value):
        from launch.frontend.parse_substitution import parse_if_substitutions
        return parse_if_substitutions(value)

    def escape_characters(self, value):
        from launch.frontend.parse_substitution import replace_escaped_characters
        return replace_escaped_characters(value)

    def parse_action(self, entity):
        """The action of an entity that a front end in Python, or the launch file itself, has made."""
        from launch.frontend import action_parse_methods
        if entity.type_name not in action_parse_methods:
            raise RuntimeError(f'Unrecognized entity of the type: {entity.type_name}')
        action, arguments = action_parse_methods[entity.type_name](entity, self)
        entity.assert_entity_completely_parsed()
        return action(**arguments)

    def parse_description(self, entity):
        """A description that includes the file, which the launcher reads itself. Without a file: the actions of it."""
        from launch.launch_description import LaunchDescription
        from launch.launch_description_sources import get_launch_description_from_any_launch_file
        if entity.type_name != 'launch':
            raise RuntimeError("Expected 'launch' as root tag")
        if self._path is not None and os.path.isfile(self._path):
            return get_launch_description_from_any_launch_file(self._path)
        return LaunchDescription([self.parse_action(child) for child in entity.children])
