# SPDX-License-Identifier: Apache-2.0
"""Type hints."""

from collections.abc import Iterable
from typing import Union

from launch.action import Action
from launch.launch_description_entity import LaunchDescriptionEntity
from launch.substitution import Substitution

SomeActionsType = Union[Action, Iterable[Action]]
SomeActionsType_types_tuple = (Action, Iterable)
SomeEntitiesType = Union[LaunchDescriptionEntity, Iterable[LaunchDescriptionEntity]]
SomeEntitiesType_types_tuple = (LaunchDescriptionEntity, Iterable)
SomeSubstitutionsType = Union[str, Substitution, Iterable[Union[str, Substitution]]]
SomeSubstitutionsType_types_tuple = (str, Substitution, Iterable)
