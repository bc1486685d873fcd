# SPDX-License-Identifier: Apache-2.0
"""
Actions and substitutions that installed packages offer to XML and YAML files.

A package names itself in the group `launch.frontend.launch_extension` of its entry points. What it imports then calls
expose_action() and expose_substitution().
"""

from launch._entities import entities, entity
from launch._places import of_element
from launch._values import LaunchFileError
from launch.action import Action
from launch.frontend._element import Element, Placed
from launch.frontend._own_actions import METHODS
from launch.frontend._parser import Parser
from launch.substitution import Substitution
from launch.substitutions import TextSubstitution

_GROUP = 'launch.frontend.launch_extension'
_failed = None  # what is wrong with the packages that could not be loaded; None: none was loaded yet


def load_packages():
    global _failed
    if _failed is not None:
        return
    _failed = []
    from importlib.metadata import entry_points
    for point in entry_points(group=_GROUP):
        try:
            point.load()
        except Exception as error:  # whatever the package raises
            _failed.append(f"the extension '{point.value}' can't be loaded: {type(error).__name__}: {error}")


def exposed(of_actions):
    """(the names, what is wrong with packages) for the error of an unknown name."""
    from launch.frontend import action_parse_methods, substitution_parse_methods
    load_packages()
    names = action_parse_methods.keys() - METHODS.keys() if of_actions else substitution_parse_methods
    return sorted(names), '\n'.join(_failed)


def make_action(data):
    """The entities of the action that a package makes of an element; None when no package knows the name."""
    from launch.frontend import action_parse_methods
    load_packages()
    element = Element(*data)
    if element.type_name not in action_parse_methods:
        return None
    return entities(ElementParser().parse_action(element))


class ElementParser(Parser):
    """Makes actions of the elements of a file that the launcher reads. The launcher makes its own ones itself."""

    def parse_substitution(self, value):
        if not isinstance(value, Placed):
            return super().parse_substitution(value)
        with of_element(value.place):
            return super().parse_substitution(str(value))

    def parse_action(self, entity):
        from launch.frontend import action_parse_methods
        if not isinstance(entity, Element):
            return super().parse_action(entity)
        if entity.type_name in METHODS or entity.type_name not in action_parse_methods:
            return _Known(entity)
        with of_element(entity.place):
            return _made(lambda: action_parse_methods[entity.type_name](entity, self), entity, entity.type_name)


def make_substitution(name, arguments, place):
    """The substitution of a package; None when no package knows the name. An argument is a list of str and numbers."""
    from launch.frontend import substitution_parse_methods
    load_packages()
    if name not in substitution_parse_methods:
        return None
    with of_element(place):
        data = [[TextSubstitution(text=part) if isinstance(part, str) else _Kept(part) for part in argument]
                for argument in arguments]
        return _made(lambda: substitution_parse_methods[name](data), None, name, place)


def _made(parse, element, name, place=None):
    """The object of the class and the arguments that parse() returns; errors are told at the place of the element."""
    place = place or element.place
    try:
        cls, arguments = parse()
        if element is not None:
            element.assert_entity_completely_parsed()
        return cls(**arguments)
    except LaunchFileError as error:
        error.of_element = error.of_element or error.place or place
        raise
    except Exception as error:
        failure = LaunchFileError(f"'{name}' can't be made: {type(error).__name__}: {error}", _raised_at(error))
        failure.of_element = place
        raise failure from error


def _raised_at(error):
    trace = error.__traceback__
    while trace is not None and trace.tb_next is not None:
        trace = trace.tb_next
    return '' if trace is None else f'raised at {trace.tb_frame.f_code.co_filename}:{trace.tb_lineno}'


class _Known(Action):
    """One of the launcher's own actions in an element. Its condition is part of it."""

    def __init__(self, element):
        super().__init__()
        self._element = element

    def describe(self):
        return f'<{self._element.type_name}>'

    def _own_entities(self):
        return [entity('an element', self._element.place, [('number', self._element.number)])]


class _Kept(Substitution):
    """One of the launcher's own substitutions in an argument."""

    def __init__(self, number):
        self._number = number

    def _part(self):
        return ('a template', [(str(self._number),)])

    def perform(self, context):
        return context._perform(self)

    def describe(self):
        return 'a substitution'
