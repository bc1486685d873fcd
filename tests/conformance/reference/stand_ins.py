# SPDX-License-Identifier: Apache-2.0
"""
What the reference engine imports beside itself, where the installation lacks it: rclpy, messages of lifecycle nodes and containers, ament_index_python.

The calls of the graph are answered by nodes that run: each goes through a command of the launcher (LAUNCH_PROGRAM), such as `launch service call`.
"""

import concurrent.futures
import enum
import importlib.abc
import importlib.machinery
import importlib.util
import json
import os
import re
import subprocess
import sys
import threading
import types

import yaml

LAUNCH = os.environ.get('LAUNCH_PROGRAM', 'launch')


class Finder(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    """Finds the modules of MODULES after everything else."""

    def find_spec(self, name, path=None, target=None):
        if name not in MODULES:
            return None
        is_package = any(other.startswith(name + '.') for other in MODULES)
        return importlib.machinery.ModuleSpec(name, self, is_package=is_package)

    def create_module(self, spec):
        return None

    def exec_module(self, module):
        module.__dict__.update(MODULES[module.__spec__.name])


class Message:
    """A message with any fields."""

    FIELDS = {}

    def __init__(self, **fields):
        self.__dict__.update({name: make() for name, make in self.FIELDS.items()})
        self.__dict__.update(fields)


def plain(value):
    """What YAML has of a message."""
    if isinstance(value, Message):
        return {name: plain(field) for name, field in vars(value).items()}
    return [plain(item) for item in value] if isinstance(value, (list, tuple)) else value


class Transition(Message):
    FIELDS = {'id': int, 'label': str}
    (TRANSITION_CREATE, TRANSITION_CONFIGURE, TRANSITION_CLEANUP, TRANSITION_ACTIVATE, TRANSITION_DEACTIVATE,
     TRANSITION_UNCONFIGURED_SHUTDOWN, TRANSITION_INACTIVE_SHUTDOWN, TRANSITION_ACTIVE_SHUTDOWN, TRANSITION_DESTROY) = range(9)


class State(Message):
    FIELDS = {'id': int, 'label': str}
    (PRIMARY_STATE_UNKNOWN, PRIMARY_STATE_UNCONFIGURED, PRIMARY_STATE_INACTIVE, PRIMARY_STATE_ACTIVE,
     PRIMARY_STATE_FINALIZED) = range(5)
    (TRANSITION_STATE_CONFIGURING, TRANSITION_STATE_CLEANINGUP, TRANSITION_STATE_SHUTTINGDOWN, TRANSITION_STATE_ACTIVATING,
     TRANSITION_STATE_DEACTIVATING, TRANSITION_STATE_ERRORPROCESSING) = range(10, 16)


class TransitionEvent(Message):
    NAME = 'lifecycle_msgs/msg/TransitionEvent'


def service(name, fields):
    request = type('Request', (Message,), {'FIELDS': fields})
    return type(name.rpartition('/')[2], (), {'NAME': name, 'Request': request, 'Response': type('Response', (Message,), {})})


ChangeState = service('lifecycle_msgs/srv/ChangeState', {'transition': Transition})
LoadNode = service('composition_interfaces/srv/LoadNode', {
    'package_name': str, 'plugin_name': str, 'node_name': str, 'node_namespace': str, 'log_level': int, 'remap_rules': list,
    'parameters': list, 'extra_arguments': list})


class ParameterType(enum.Enum):
    NOT_SET, BOOL, INTEGER, DOUBLE, STRING, BYTE_ARRAY, BOOL_ARRAY, INTEGER_ARRAY, DOUBLE_ARRAY, STRING_ARRAY = range(10)

    def check(self, value):
        kinds = {'BOOL': bool, 'INTEGER': int, 'DOUBLE': float, 'STRING': str, 'BYTE_ARRAY': bytes}
        name, _, array = self.name.partition('_ARRAY') if self.name != 'BYTE_ARRAY' else (self.name, '', '')
        if self.name == 'NOT_SET':
            return value is None
        if self.name.endswith('_ARRAY') and self.name != 'BYTE_ARRAY':
            if not isinstance(value, (list, tuple)) and type(value).__name__ != 'array':
                return False
            return all(type(item) is kinds[name] or (name == 'BYTE_ARRAY' and isinstance(item, bytes)) for item in value)
        return type(value) is kinds[name] or (name == 'BYTE_ARRAY' and isinstance(value, (list, tuple)) and bool(value)
                                              and all(isinstance(item, bytes) for item in value))


class Parameter:
    Type = ParameterType
    FIELDS = {'BOOL': 'bool_value', 'INTEGER': 'integer_value', 'DOUBLE': 'double_value', 'STRING': 'string_value'}

    def __init__(self, name, type_=None, value=None):
        self.name, self.value = name, value
        self.type_ = type_ or next((one for one in ParameterType if one.check(value)), ParameterType.NOT_SET)

    def to_parameter_msg(self):
        field = self.FIELDS.get(self.type_.name, self.type_.name.lower() + '_values')
        value = list(self.value) if self.type_.name.endswith('_ARRAY') else self.value
        return Message(name=self.name, value=Message(type=self.type_.value, **{field.replace('_array_values', '_array_value'): value}))


def validate_node_name(name):
    if not re.fullmatch('[A-Za-z_][A-Za-z0-9_]*', name):
        raise ValueError(f'Invalid node name: {name!r}')
    return True


def validate_namespace(namespace):
    if not re.fullmatch('/|(/[A-Za-z_][A-Za-z0-9_]*)+', namespace):
        raise ValueError(f'Invalid namespace: {namespace!r}')
    return True


def ask(*words, seconds=20):
    return subprocess.run([LAUNCH, *words], capture_output=True, text=True, check=False, timeout=seconds)


class Client:
    """The client of a service, which a command calls."""

    def __init__(self, kind, name):
        self.kind, self.srv_name = kind, name
        self._pool = concurrent.futures.ThreadPoolExecutor(4)

    def wait_for_service(self, timeout_sec=None):
        name = self.srv_name if self.srv_name.startswith('/') else '/' + self.srv_name
        return name in ask('service', 'list').stdout.split()

    def call_async(self, request):
        return self._pool.submit(self._call, request)

    def _call(self, request):
        name = self.srv_name if self.srv_name.startswith('/') else '/' + self.srv_name
        if self.kind is ChangeState:
            # The subscription of this launch is a program that starts; rclpy has its own at once.
            topic = name.replace('/change_state', '/transition_event')
            for _ in range(20):
                if re.search('Subscription count: [1-9]', ask('topic', 'info', topic).stdout):
                    break
        answer = ask('service', 'call', name, self.kind.NAME, yaml.safe_dump(plain(request), default_flow_style=True, width=1e9)).stdout
        text = dict(re.findall(r"(\w+)='([^']*)'", answer))
        return Message(success='success=True' in answer, error_message=text.get('error_message', ''),
                       full_node_name=text.get('full_node_name', ''), unique_id=0)


class Subscription:
    """A subscription of the transitions of a node, which a command follows."""

    def __init__(self, kind, name, callback):
        self._process = subprocess.Popen([LAUNCH, 'topic', 'echo', name, kind.NAME], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        threading.Thread(target=self._follow, args=[callback], daemon=True).start()

    def _follow(self, callback):
        lines = []
        for line in self._process.stdout:
            if line.strip() != '---':
                lines.append(line)
                continue
            event, lines = yaml.safe_load(''.join(lines)), []
            callback(TransitionEvent(transition=Transition(**event['transition']), start_state=State(**event['start_state']),
                                     goal_state=State(**event['goal_state']), timestamp=event.get('timestamp', 0)))

    def destroy(self):
        self._process.kill()


class Node:
    def __init__(self, name):
        self._name, self._subscriptions = name, []

    def create_client(self, kind, name, **_):
        return Client(kind, name)

    def create_subscription(self, kind, name, callback, *_, **__):
        self._subscriptions.append(Subscription(kind, name, callback))
        return self._subscriptions[-1]

    def destroy_node(self):
        for subscription in self._subscriptions:
            subscription.destroy()


class SilentNode:
    """Of a launch that starts nothing: nobody answers."""

    def create_client(self, kind, name, **_):
        client = Client(kind, name)
        client.wait_for_service = lambda timeout_sec=None: threading.Event().wait(timeout_sec)
        return client

    def create_subscription(self, *_, **__):
        return None


class Executor:
    def __init__(self, **_):
        self._changed = threading.Event()

    def add_node(self, node):
        pass

    remove_node = add_node

    def spin_once(self, timeout_sec=None):
        self._changed.wait(timeout_sec)


def prefixes():
    return [path for path in os.environ.get('AMENT_PREFIX_PATH', '').split(os.pathsep) if path]


class PackageNotFoundError(KeyError):
    pass


def get_package_prefix(package_name):
    for prefix in prefixes():
        if os.path.exists(f'{prefix}/share/ament_index/resource_index/packages/{package_name}'):
            return prefix
    raise PackageNotFoundError(f"package '{package_name}' not found, searching: {prefixes()}")


def get_package_share_directory(package_name, print_warning=True):
    # The engine's own data lies beside it where it is not installed.
    spec = importlib.util.find_spec(package_name) if package_name == 'launch' else None
    own = os.path.join(os.path.dirname(os.path.dirname(spec.origin)), 'share', package_name) if spec and spec.origin else ''
    if os.path.isdir(own):
        return own
    return os.path.join(get_package_prefix(package_name), 'share', package_name)


def get_packages_with_prefixes():
    found = {}
    for prefix in reversed(prefixes()):
        index = f'{prefix}/share/ament_index/resource_index/packages'
        found.update({name: prefix for name in (os.listdir(index) if os.path.isdir(index) else [])})
    return found


PACKAGES = {'PackageNotFoundError': PackageNotFoundError, 'get_package_prefix': get_package_prefix,
            'get_package_share_directory': get_package_share_directory, 'get_packages_with_prefixes': get_packages_with_prefixes}
MODULES = {
    'rclpy': {'Context': types.SimpleNamespace, 'init': lambda **_: None, 'shutdown': lambda **_: None,
              'create_node': lambda name, **_: Node(name), 'Parameter': Parameter, '__path__': []},
    'rclpy.parameter': {'Parameter': Parameter},
    'rclpy.node': {'Node': Node},
    'rclpy.executors': {'SingleThreadedExecutor': Executor},
    'rclpy.validate_namespace': {'validate_namespace': validate_namespace},
    'rclpy.validate_node_name': {'validate_node_name': validate_node_name},
    'rclpy.logging': {'get_logging_directory': lambda: os.path.expanduser('~/.ros/log')},
    'lifecycle_msgs': {'__path__': []},
    'lifecycle_msgs.msg': {'Transition': Transition, 'State': State, 'TransitionEvent': TransitionEvent},
    'lifecycle_msgs.srv': {'ChangeState': ChangeState},
    'composition_interfaces': {'__path__': []},
    'composition_interfaces.srv': {'LoadNode': LoadNode},
    'ament_index_python': {'__path__': [], **PACKAGES},
    'ament_index_python.packages': PACKAGES,
}


def install():
    sys.meta_path.append(Finder())


def load_request(request):
    """A request of LoadNode in the form of the records."""
    def parameters(messages):
        return [{'name': one.name, 'type': one.value.type, 'value': json.loads(json.dumps(
            next(value for name, value in vars(one.value).items() if name != 'type'), default=str))} for one in messages]
    return {'package': request.package_name, 'plugin': request.plugin_name, 'name': request.node_name or None,
            'namespace': request.node_namespace or None, 'parameters': parameters(request.parameters),
            'remaps': list(request.remap_rules), 'extra_arguments': parameters(request.extra_arguments)}
