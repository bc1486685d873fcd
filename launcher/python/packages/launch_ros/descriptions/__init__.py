# SPDX-License-Identifier: Apache-2.0
"""Descriptions of nodes that containers load, and of parameters."""

from launch import _names
from launch._entities import entity
from launch._places import Located
from launch._values import WrongKind, boolean, items, mapping, pairs, text
from launch.condition import Condition
from launch.substitutions import parts_of
from launch_ros._parameters import as_yaml, parameter_items
from launch_ros.parameter_descriptions import Parameter, ParameterFile, ParameterValue


class ComposableNode(Located):
    _tag = 'composable_node'

    def __init__(self, *, package, plugin, name=None, namespace=None, parameters=None, remappings=None,
                 extra_arguments=None, condition=None):
        if condition is not None and not isinstance(condition, Condition):
            raise WrongKind(f'condition must be a Condition, got {type(condition).__name__}')
        self._package = text(package, 'package')
        self._plugin = text(plugin, 'plugin')
        self._name = None if name is None else text(name, 'name')
        self._namespace = None if namespace is None else text(namespace, 'namespace')
        self._condition = condition
        self._attributes = []
        self._parameters = parameters
        self._remappings = pairs(remappings or [], 'remappings')
        self._extra = extra_arguments

    @classmethod
    def parse(cls, parser, entity):
        """The class and the arguments that it takes from an element of XML or YAML."""
        from launch.frontend._arguments import arguments_of
        return cls, arguments_of(cls, entity, parser)

    def condition(self):
        """A method, as in ROS 2."""
        return self._condition

    @property
    def package(self):
        return parts_of(self._package)

    @property
    def node_plugin(self):
        return parts_of(self._plugin)

    @property
    def node_name(self):
        return None if self._name is None else parts_of(self._name)

    @property
    def node_namespace(self):
        return None if self._namespace is None else parts_of(self._namespace)

    @property
    def parameters(self):
        return self._parameters

    @property
    def remappings(self):
        return [(parts_of(from_), parts_of(to)) for from_, to in self._remappings]

    @property
    def extra_arguments(self):
        return self._extra

    def _item(self):
        place = self._place()
        children = parameter_items(self._parameters, place)
        children += [entity('remap', place, [('from', from_), ('to', to)]) for from_, to in self._remappings]
        for given in items(self._extra or [], 'extra_arguments'):
            children += [entity('extra_arg', place, [('name', text(name, 'a name')), ('value', as_yaml(value))])
                         for name, value in mapping(given, 'an item of extra_arguments')]
        when = [] if self._condition is None else [self._condition._attribute()]
        return entity(self._tag, place,
                      [('pkg', self._package), ('plugin', self._plugin), ('name', self._name or ''),
                       ('namespace', self._namespace), *when, *self._attributes], children)


class ComposableLifecycleNode(ComposableNode):
    _tag = 'composable_lifecycle_node'

    def __init__(self, *, autostart=False, **kwargs):
        super().__init__(**kwargs)
        self._attributes.append(('autostart', boolean(autostart, 'autostart')))


_names.one_class_modules(__name__)
__all__ = ['ComposableLifecycleNode', 'ComposableNode', 'Parameter', 'ParameterFile', 'ParameterValue']
