# SPDX-License-Identifier: Apache-2.0
"""What a launch description can hold."""

from launch._places import Located


class LaunchDescriptionEntity(Located):

    def visit(self, context):
        return None

    def describe(self):
        return type(self).__name__

    def describe_sub_entities(self):
        """The entities that are visited whatever happens."""
        return []

    def describe_conditional_sub_entities(self):
        """Pairs of a text and the entities that are visited only if what it describes happens."""
        return []

    def get_asyncio_future(self):
        return None

    def _entities(self):
        raise NotImplementedError
