# SPDX-License-Identifier: Apache-2.0
"""Launch files in Python: the names of ROS 2's package `launch`, on the launcher that runs this file."""

import sys

from launch import _lazy, _names
from launch.action import Action
from launch.condition import Condition
from launch.event import Event
from launch.event_handler import BaseEventHandler, EventHandler
from launch.launch_context import LaunchContext
from launch.launch_description import LaunchDescription
from launch.launch_description_entity import LaunchDescriptionEntity
from launch.launch_description_source import LaunchDescriptionSource
from launch.launch_service import LaunchIntrospector, LaunchService
from launch.some_types import (
    SomeActionsType, SomeActionsType_types_tuple, SomeEntitiesType, SomeEntitiesType_types_tuple,
    SomeSubstitutionsType, SomeSubstitutionsType_types_tuple)
from launch.substitution import Substitution

_MODULES = ('actions', 'conditions', 'descriptions', 'event_handlers', 'events', 'frontend', 'launch_description_sources',
            'logging', 'substitutions', 'utilities')
__all__ = [name for name in vars() if name[0] != '_' and name != 'sys'] + ['InvalidLaunchFileError', *_MODULES]

_names.same_module('launch.some_types', 'launch.some_actions_type', 'launch.some_entities_type',
                   'launch.some_substitutions_type')


def __getattr__(name):
    if name == 'InvalidLaunchFileError':
        from launch.launch_description_sources import InvalidLaunchFileError
        return InvalidLaunchFileError
    return _lazy.module(__name__, name, _MODULES)


def __dir__():
    return __all__
