# SPDX-License-Identifier: Apache-2.0
"""LaunchDescription: what a launch file asks for."""

from launch._entities import entities, entity
from launch._places import Located
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

    def describe_sub_entities(self):
        return self._contents

    def get_launch_arguments(self, conditional_inclusion=False):
        """The arguments that are declared here and in included descriptions that exist already, without conditions."""
        return [argument for argument, _ in self.get_launch_arguments_with_include_launch_description_actions(
            conditional_inclusion)]

    def get_launch_arguments_with_include_launch_description_actions(self, conditional_inclusion=False):
        """Pairs of an argument and the list of includes that lead to it."""
        from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
        found = []

        def search(entities, includes, conditional):
            for each in entities:
                if isinstance(each, DeclareLaunchArgument):
                    each._conditionally_included = conditional or each.condition is not None
                    if all(argument.name != each.name for argument, _ in found):
                        found.append((each, includes))
                    continue
                inner = [*includes, each] if isinstance(each, IncludeLaunchDescription) else includes
                search(each.describe_sub_entities(), inner, conditional)
                for _, conditional_entities in each.describe_conditional_sub_entities():
                    search(conditional_entities, inner, True)

        search(self._contents, [], conditional_inclusion)
        return found

    def _entities(self):
        count = len(self._contents)
        found = entities(self._contents, self._place())
        # A function of the file that is called during the visit may append to the description that holds it.
        if any(obj is not None for _tag, _place, _attributes, _children, obj, _name in found):
            found.append(entity('', self._place(), [], obj=_Appended(self, count)))
        return found


class _Appended(Located):
    """What a description has got since it was read."""

    def __init__(self, description, count):
        self._description = description
        self._count = count

    def describe(self):
        return 'what was appended to the launch description'

    def _calls(self):
        return None

    def _execute(self):
        contents = self._description._contents
        found = entities(contents[self._count:], self._place())
        self._count = len(contents)
        return found
