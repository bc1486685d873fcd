# SPDX-License-Identifier: Apache-2.0
"""Actions that run ROS nodes."""

from launch._dispatch import _Step
from launch._entities import entity
from launch._values import LaunchFileError, boolean, items, pairs, text, words
from launch.action import Action
from launch.actions._processes import _Process
from launch.descriptions import Executable
from launch.launch_context import LaunchContext
from launch.substitution import Substitution
from launch.substitutions._builtin import described
from launch_ros._parameters import parameter_items
from launch_ros._transitions import name_of_transition
from launch_ros.descriptions import ComposableNode

_NODE_ARGUMENTS = ('package', 'executable', 'name', 'namespace', 'exec_name', 'parameters', 'remappings', 'ros_arguments',
                   'arguments')
_FORMER = {'node_name': 'it is name now', 'node_executable': 'it is executable now',
           'node_namespace': 'it is namespace now'}


_UNSPECIFIED_NAME = '<node_name_unspecified>'
_UNSPECIFIED_NAMESPACE = '<node_namespace_unspecified>'


class Node(_Process):
    _tag = 'node'

    UNSPECIFIED_NODE_NAME = _UNSPECIFIED_NAME
    UNSPECIFIED_NODE_NAMESPACE = _UNSPECIFIED_NAMESPACE

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
        self.node_package = package
        self.node_executable = executable
        self._executable = text(executable, 'executable')
        self._exec_name = given(exec_name, 'exec_name')
        self._args = words(arguments, 'arguments') if arguments else []
        self._ros_args = words(ros_arguments, 'ros_arguments') if ros_arguments else []
        self._more_attributes = []
        self._description = None
        self._is_target = False  # a handler or an event is about this node
        self._visited_name = None  # the full name of its latest visit, if it is a target
        self._tells_name = False  # whether its visit sets that
        self._waiting_handlers = []  # those of OnStateTransition that were registered before
        # Read now, because a launch file may change its mappings later.
        self._parameters = parameter_items(parameters, self._place_of('parameters') or self._place())
        self._remappings = pairs(remappings or [], 'remappings')

    @property
    def process_description(self):
        """The program with its arguments. What a file appends to its `cmd` comes after them."""
        if self._description is None:
            self._description = Executable(
                cmd=self._words(), **{name: self._options[name] for name in Executable._OPTIONS
                                      if name != 'name' and self._options.get(name) is not None})
            self._description._options['name'] = self._exec_name or self._executable
        return self._description

    @property
    def node_name(self):
        """The fully qualified name, once the node is visited."""
        if not self._was_read:
            raise RuntimeError("cannot access 'node_name' before executing action")
        context = LaunchContext._of_launch()
        if self._name is not None:
            return _FullName(self).perform(context)
        return _full_namespace(self, context).rstrip('/') + '/' + self.UNSPECIFIED_NODE_NAME

    @property
    def expanded_node_namespace(self):
        return _full_namespace(self, LaunchContext._of_launch())

    @property
    def expanded_remapping_rules(self):
        context = LaunchContext._of_launch()
        return [(context._perform(from_), context._perform(to)) for from_, to in self._remappings] or None

    def is_node_name_fully_specified(self):
        return self._name is not None

    def _words(self):
        from launch_ros.substitutions import ExecutableInPackage
        program = (self._executable if self._package is None else
                   (ExecutableInPackage(package=self._package, executable=self._executable),))
        return [program, *self._args, *([('--ros-args',), *self._ros_args] if self._ros_args else [])]

    def _tags(self):
        place = self._place_of('remappings') or self._place()
        remaps = [entity('remap', place, [('from', from_), ('to', to)]) for from_, to in self._remappings]
        arguments, ros_arguments = self._args, self._ros_args
        if self._description is not None and len(self._description.cmd) != len(self._words()):
            arguments, ros_arguments = self._description._command[1:], []  # the file has changed them
        name = (_NameOfTarget(self),) if self._is_target else self._name
        attributes = [('pkg', self._package), ('exec', self._executable), ('name', name),
                      ('namespace', self._namespace), ('exec_name', self._exec_name), ('args', arguments or None),
                      ('ros_args', ros_arguments or None), *self._more_attributes]
        found = self._with_handlers(self._tag, attributes, [*self._parameters, *remaps, *self._more_items()])
        self._tells_name = self._is_target
        if self._is_target:
            step = _WaitingHandlers(self)
            step._made_at = self._made_at
            found.append(entity('', self._place(), self._when(), obj=step))
        return found

    def _has_been_visited(self):
        # A node that nobody was about when it was read does not tell when it is visited.
        return self._visited_name is not None or (self._was_read and not self._tells_name)

    def _more_items(self):
        return []


class _WaitingHandlers(_Step):
    """Registers the handlers of a node that were there before it."""

    def __init__(self, node):
        self._node = node

    def _do(self, context):
        handlers, self._node._waiting_handlers = self._node._waiting_handlers, []
        return [handler._tag() for handler in handlers]


class LifecycleNode(Node):
    _tag = 'lifecycle_node'

    def __init__(self, *, name, namespace, autostart=False, **kwargs):
        super().__init__(name=name, namespace=namespace, **kwargs)
        self._is_listed = False
        self._is_target = self._name is not None
        if autostart is not False:
            self._more_attributes.append(('autostart', boolean(autostart, 'autostart')))


    def _tags(self):
        if not self._is_listed:
            self._is_listed = True
            lifecycle_nodes.append(self)
        return super()._tags()


# Those that a matcher of ChangeState may accept.
lifecycle_nodes = []


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
        self._is_target = self._name is not None
        self._descriptions = _descriptions(composable_node_descriptions)

    def _more_items(self):
        return [description._item() for description in self._descriptions]


def full_name(node):
    """The fully qualified name of a node, as a substitution. The node must have a name."""
    if node._name is None:
        raise LaunchFileError(f'the {type(node).__name__} needs a name')
    node._is_target = True
    return _FullName(node)


class _FullName(Substitution):

    def __init__(self, node):
        self._node = node

    def perform(self, context):
        return self._node._visited_name or _full_name_in(self._node, context)


class _NameOfTarget(Substitution):
    """
    The name of a node that others are about. They mean this node, also where its name would be another one.

    The configurations that its name has, and the namespace around it, may have gone by then.
    """

    def __init__(self, node):
        self._node = node

    def describe(self):
        return described(self._node._name)

    def perform(self, context):
        self._node._visited_name = _full_name_in(self._node, context)
        return context._perform(self._node._name)


def _full_name_in(node, context):
    return _full_namespace(node, context).rstrip('/') + '/' + context._perform(node._name)


def _full_namespace(node, context):
    namespace = context._perform(node._namespace or '')
    if not namespace.startswith('/'):
        namespace = context.launch_configurations.get('ros_namespace', '').rstrip('/') + '/' + namespace
    return '/' + namespace.strip('/')


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
