# SPDX-License-Identifier: Apache-2.0
"""Actions that run ROS nodes."""

from launch._entities import entity
from launch._values import LaunchFileError, boolean, items, pairs, text, words
from launch.action import Action
from launch.actions._processes import _Process
from launch.substitution import Substitution
from launch_ros._parameters import parameter_items
from launch_ros.descriptions import ComposableNode
from launch_ros.events.lifecycle import name_of_transition

_NODE_ARGUMENTS = ('package', 'executable', 'name', 'namespace', 'exec_name', 'parameters', 'remappings', 'ros_arguments',
                   'arguments')
_FORMER = {'node_name': 'it is name now', 'node_executable': 'it is executable now',
           'node_namespace': 'it is namespace now'}


class Node(_Process):
    _tag = 'node'

    def __init__(self, *, executable=None, package=None, name=None, namespace=None, exec_name=None, parameters=None,
                 remappings=None, ros_arguments=None, arguments=None, **kwargs):
        self._take(kwargs, _NODE_ARGUMENTS, _FORMER)
        if executable is None:
            raise LaunchFileError(f'{type(self).__name__} needs executable')

        def given(value, what):
            return None if value is None else text(value, what)

        self._package = given(package, 'package')
        self._name = given(name, 'name')
        self._namespace = given(namespace, 'namespace')
        self._attributes = [('pkg', self._package), ('exec', text(executable, 'executable')), ('name', self._name),
                            ('namespace', self._namespace), ('exec_name', given(exec_name, 'exec_name')),
                            ('args', words(arguments, 'arguments') if arguments else None),
                            ('ros_args', words(ros_arguments, 'ros_arguments') if ros_arguments else None)]
        # Read now, because a launch file may change its mappings later.
        self._parameters = parameter_items(parameters, self._place_of('parameters') or self._place())
        self._remappings = pairs(remappings or [], 'remappings')

    def _tags(self):
        place = self._place_of('remappings') or self._place()
        remaps = [entity('remap', place, [('from', from_), ('to', to)]) for from_, to in self._remappings]
        return self._with_handlers(self._tag, self._attributes, [*self._parameters, *remaps, *self._more_items()])

    def _more_items(self):
        return []


class LifecycleNode(Node):
    _tag = 'lifecycle_node'

    def __init__(self, *, name, namespace, autostart=False, **kwargs):
        super().__init__(name=name, namespace=namespace, **kwargs)
        if autostart is not False:
            self._attributes.append(('autostart', boolean(autostart, 'autostart')))


def _descriptions(descriptions):
    descriptions = [descriptions] if isinstance(descriptions, ComposableNode) else (
        items(descriptions or [], 'composable_node_descriptions'))
    for description in descriptions:
        if not isinstance(description, ComposableNode):
            raise LaunchFileError('composable_node_descriptions holds ComposableNode, '
                                  f'got {type(description).__name__}')
    return descriptions


class ComposableNodeContainer(Node):
    _tag = 'node_container'

    def __init__(self, *, name, namespace, composable_node_descriptions=None, **kwargs):
        super().__init__(name=name, namespace=namespace, **kwargs)
        self._descriptions = _descriptions(composable_node_descriptions)

    def _more_items(self):
        return [description._item() for description in self._descriptions]


def full_name(node):
    """The fully qualified name of a node, as a substitution. The node must have a name."""
    if node._name is None:
        raise LaunchFileError(f'the {type(node).__name__} needs a name')
    return _FullName(node)


class _FullName(Substitution):

    def __init__(self, node):
        self._node = node

    def perform(self, context):
        namespace = context._perform(self._node._namespace or '')
        if not namespace.startswith('/'):
            namespace = context.launch_configurations.get('ros_namespace', '').rstrip('/') + '/' + namespace
        return ('/' + namespace.strip('/')).rstrip('/') + '/' + context._perform(self._node._name)


class LoadComposableNodes(Action):

    def __init__(self, *, composable_node_descriptions, target_container, **kwargs):
        super().__init__(**kwargs)
        if isinstance(target_container, ComposableNodeContainer):
            target_container = full_name(target_container)
        self._target = text(target_container, 'target_container')
        self._descriptions = _descriptions(composable_node_descriptions)

    def _tags(self):
        if not self._descriptions:
            return []
        return [entity('load_composable_node', self._place(),
                       self._with_places([('target', self._target), *self._when()]),
                       [description._item() for description in self._descriptions])]


class LifecycleTransition(Action):
    """Changes the state of nodes: each node goes through the transitions in turn."""

    def __init__(self, *, lifecycle_node_names, transition_ids, **kwargs):
        super().__init__(**kwargs)
        self._nodes = words(lifecycle_node_names, 'lifecycle_node_names')
        self._transitions = [(name_of_transition(number),) for number in items(transition_ids, 'transition_ids')]

    def _tags(self):
        return [entity('lifecycle_transition', self._place(),
                       [('node', node), ('transitions', self._transitions), *self._when()]) for node in self._nodes]
