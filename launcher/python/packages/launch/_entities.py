# SPDX-License-Identifier: Apache-2.0
"""Turns the objects of a launch file into what the launcher reads (launcher/python/module/entity_reader.hpp)."""

from collections.abc import Iterable

from launch._values import LaunchFileError, name_of


def entity(tag, place, attributes, children=(), obj=None, process_name=''):
    """`attributes` are (name, value) or (name, value, place); an attribute whose value is None is left out."""
    return (tag, place, [pair for pair in attributes if pair[1] is not None], list(children), obj, process_name)


def entities(objects, place=None):
    """The entities of actions, lists of actions and launch descriptions, in order. `place` is where they are held."""
    result = []
    _collect(objects, result, place)
    return result


def _collect(objects, result, place):
    from launch.launch_description_entity import LaunchDescriptionEntity
    if objects is None:
        return
    if isinstance(objects, LaunchDescriptionEntity):
        result.extend(objects._entities())
    elif isinstance(objects, Iterable) and not isinstance(objects, (str, bytes)):
        for item in objects:
            if item is None:
                raise LaunchFileError('expected an action, got None', '', place)
            _collect(item, result, place)
    else:
        raise LaunchFileError(f'expected an action, got {name_of(objects)}', '', place)
