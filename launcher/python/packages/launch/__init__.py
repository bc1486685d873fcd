# SPDX-License-Identifier: Apache-2.0
"""Launch files in Python: the names of ROS 2's package `launch`, on the launcher that runs this file."""

import sys

from launch import _names
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

from launch import (  # noqa: I100  after the classes that they use
    actions, conditions, descriptions, event_handlers, events, frontend, launch_description_sources, substitutions,
    utilities)

InvalidLaunchFileError = launch_description_sources.InvalidLaunchFileError

_names.same_module('launch.some_types', 'launch.some_actions_type', 'launch.some_entities_type',
                   'launch.some_substitutions_type')


def __getattr__(name):
    if name == 'logging':  # logging takes as long to load as all the rest
        import importlib
        return importlib.import_module('launch.logging')
    raise AttributeError(f"module 'launch' has no attribute '{name}'", name=name, obj=sys.modules[__name__])
