# SPDX-License-Identifier: Apache-2.0
"""Type hints."""

from collections.abc import Iterable

from launch.action import Action
from launch.launch_description_entity import LaunchDescriptionEntity
from launch.substitution import Substitution

SomeActionsType = Action | Iterable[Action]
SomeActionsType_types_tuple = (Action, Iterable)
SomeEntitiesType = LaunchDescriptionEntity | Iterable[LaunchDescriptionEntity]
SomeEntitiesType_types_tuple = (LaunchDescriptionEntity, Iterable)
SomeSubstitutionsType = str | Substitution | Iterable[str | Substitution]
SomeSubstitutionsType_types_tuple = (str, Substitution, Iterable)
