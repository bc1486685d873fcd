# SPDX-License-Identifier: Apache-2.0
"""The module that ROS 2 has under this name, too."""

from launch.utilities.type_utils import *  # noqa: F401,F403
from launch.utilities.type_utils import is_typing_list


def check_is_list_entity(data_type):
    """Whether the type is a list of entities, as in get_attr(name, data_type=List[Entity])."""
    from launch.frontend._parser import Entity
    inner = getattr(data_type, '__args__', None) or ()
    return is_typing_list(data_type) and any(isinstance(item, type) and issubclass(item, Entity) for item in inner)
