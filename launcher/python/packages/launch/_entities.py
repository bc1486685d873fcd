# SPDX-License-Identifier: Apache-2.0
"""Turns the objects of a launch file into what the launcher reads (launcher/python/module/entity_reader.hpp)."""

from collections.abc import Iterable

from launch._values import LaunchFileError, WrongKind, name_of


class told_at:  # noqa: N801  as contextlib has it
    """Errors of the block that have no place of their own are told where the object was made."""

    def __init__(self, made):
        self._made = made

    def __enter__(self):
        return self

    def __exit__(self, _kind, error, _trace):
        if error is not None and getattr(error, 'place', None) is None:
            try:
                error.place = self._made._place()
            except AttributeError:
                pass  # a class of the user's that was not initialised, or an exception that holds nothing more
        return False


def entity(tag, place, attributes, children=(), obj=None, process_name=''):
    """`attributes` are (name, value) or (name, value, place); an attribute whose value is None is left out."""
    return (tag, place, [pair for pair in attributes if pair[1] is not None], list(children), obj, process_name)


def entities(objects, place=None):
    """The entities of actions, lists of actions and launch descriptions, in order. `place` is where they are held."""
    result = []
    _collect(objects, result, place)
    return result


# More than any launch file has: an endless iterator must not fill the memory.
_MOST_ENTITIES = 1_000_000


def _collect(objects, result, place):
    from launch.launch_description_entity import LaunchDescriptionEntity
    if objects is None:
        return
    if isinstance(objects, LaunchDescriptionEntity):
        with told_at(objects):
            result.extend(objects._entities())
    elif isinstance(objects, Iterable) and not isinstance(objects, (str, bytes)):
        for item in objects:
            if item is None:
                raise WrongKind('expected an action, got None', '', place)
            if len(result) > _MOST_ENTITIES:
                raise LaunchFileError(f'a launch description holds more than {_MOST_ENTITIES} actions', '', place)
            _collect(item, result, place)
    else:
        raise WrongKind(f'expected an action, got {name_of(objects)}', '', place)
