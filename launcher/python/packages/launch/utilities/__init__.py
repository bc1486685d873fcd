# SPDX-License-Identifier: Apache-2.0
"""Functions that launch files and other packages use."""

from collections.abc import Iterable

from launch import _names
from launch._values import items, text
from launch.substitution import Substitution


def normalize_to_list_of_substitutions(subs):
    from launch.substitutions import TextSubstitution
    return [part if isinstance(part, Substitution) else TextSubstitution(text=part)
            for part in text(subs, 'a substitution')]


def perform_substitutions(context, subs):
    return ''.join(part if isinstance(part, str) else context.perform_substitution(part) for part in subs)


def normalize_to_list_of_entities(entities):
    return items(entities, 'entities') if isinstance(entities, Iterable) else [entities]


def is_a(obj, entity_type):
    return isinstance(obj, entity_type)


def is_a_subclass(obj, entity_type):
    """Whether it is a class derived from the other one, or an object of such a class."""
    return isinstance(obj, entity_type) or (isinstance(obj, type) and issubclass(obj, entity_type))


def isclassinstance(obj):
    return hasattr(obj, '__class__') and not isinstance(obj, type)


def ensure_argument_type(argument, types, argument_name, caller=None):
    types = tuple(types) if isinstance(types, Iterable) else (types,)
    if not isinstance(argument, types):
        names = ', '.join(getattr(known, '__name__', str(known)) for known in types)
        raise TypeError(f"{caller + ': ' if caller else ''}expected '{argument_name}' to be one of [{names}], "
                        f"got {type(argument).__name__}")


_names.same_module(__name__, *(f'{__name__}.{name}' for name in (
    'class_tools_impl', 'ensure_argument_type_impl', 'normalize_to_list_of_entities_impl',
    'normalize_to_list_of_substitutions_impl', 'perform_substitutions_impl')))
