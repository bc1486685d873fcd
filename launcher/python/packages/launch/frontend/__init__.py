# SPDX-License-Identifier: Apache-2.0
"""What packages use to offer their actions and substitutions to XML and YAML files."""

from launch import _names
from launch.frontend._own_actions import METHODS
from launch.frontend._parser import Entity, InvalidFrontendLaunchFileError, Parser
from launch.frontend.parse_substitution import parse_if_substitutions, parse_substitution

action_parse_methods = dict(METHODS)
substitution_parse_methods = {}


def _exposed(name, methods, what):
    def decorate(exposed):
        method = exposed.parse if isinstance(exposed, type) and hasattr(exposed, 'parse') else exposed
        if isinstance(method, type) or not callable(method):
            raise RuntimeError("Did not find a class method called 'parse' in the class being decorated.")
        if methods.setdefault(name, method) != method:
            raise RuntimeError(f'Two {what} parsing methods exposed with the same name: [{name}].')
        return exposed
    return decorate


def expose_action(name):
    """A decorator: elements of XML and YAML files that have this name are parsed by parse() of the class."""
    return _exposed(name, action_parse_methods, 'action')


def expose_substitution(name):
    """A decorator: $(name …) in XML and YAML files is parsed by parse() of the class."""
    return _exposed(name, substitution_parse_methods, 'substitution')


_names.one_class_modules(__name__)
_names.same_module(__name__, __name__ + '.expose')
