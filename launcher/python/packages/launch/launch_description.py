# SPDX-License-Identifier: Apache-2.0
"""LaunchDescription: what a launch file asks for."""

from launch._entities import entities
from launch._values import items
from launch.launch_description_entity import LaunchDescriptionEntity


class LaunchDescription(LaunchDescriptionEntity):

    def __init__(self, initial_entities=None, *, deprecated_reason=None):
        self._contents = [] if initial_entities is None else items(
            initial_entities, 'initial_entities', 1_000_000)
        self.deprecated_reason = deprecated_reason

    @property
    def entities(self):
        return self._contents

    @property
    def deprecated(self):
        return self.deprecated_reason is not None

    def add_entity(self, entity):
        self._contents.append(entity)

    def add_action(self, action):
        self.add_entity(action)

    def visit(self, context):
        return self._contents

    def _entities(self):
        return entities(self._contents, self._place())
