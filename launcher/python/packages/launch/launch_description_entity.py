# SPDX-License-Identifier: Apache-2.0
"""What a launch description can hold."""

from launch._places import Located


class LaunchDescriptionEntity(Located):

    def visit(self, context):
        return None

    def describe(self):
        return type(self).__name__

    def _entities(self):
        raise NotImplementedError
