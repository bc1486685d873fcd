# SPDX-License-Identifier: Apache-2.0
"""
Writes the names that Python launch files import, for the language server: {module: {name: {"kind", "help", "arguments"}}}.

    write_python_names.py PACKAGES OUTPUT
"""

import importlib
import inspect
import json
import pkgutil
import sys

PACKAGES = ('launch', 'launch_ros', 'launch_testing', 'launch_xml', 'launch_yaml', 'ament_index_python')
# The tags of XML that mean the same, for their help.
TAGS = {
    'AppendEnvironmentVariable': 'append_env', 'ComposableNode': 'composable_node', 'ComposableNodeContainer': 'node_container',
    'DeclareLaunchArgument': 'arg', 'ExecuteLocal': 'executable', 'ExecuteProcess': 'executable', 'GroupAction': 'group',
    'IncludeLaunchDescription': 'include', 'LifecycleNode': 'lifecycle_node', 'LifecycleTransition': 'lifecycle_transition',
    'LoadComposableNodes': 'load_composable_node', 'LogInfo': 'log', 'Node': 'node', 'PushROSNamespace': 'push_ros_namespace',
    'PushRosNamespace': 'push_ros_namespace', 'ResetEnvironment': 'reset_env', 'SetEnvironmentVariable': 'set_env',
    'SetLaunchConfiguration': 'let', 'SetParameter': 'set_parameter', 'SetParametersFromFile': 'set_parameters_from_file',
    'SetROSLogDir': 'set_ros_log_dir', 'SetRemap': 'set_remap', 'SetUseSimTime': 'set_use_sim_time', 'Shutdown': 'shutdown',
    'TimerAction': 'timer', 'UnsetEnvironmentVariable': 'unset_env', 'UnsetLaunchConfiguration': 'unset'}
LEFT_OUT = ('launch_testing.',)  # the modules of tests are not for launch files


def is_public(name):
    return not any(part.startswith('_') for part in name.split('.'))


def modules():
    """The names of all public modules of the packages."""
    for package in PACKAGES:
        yield package
        path = importlib.import_module(package).__path__
        for module in pkgutil.walk_packages(path, package + '.', onerror=lambda name: None):
            if is_public(module.name) and not module.name.startswith(LEFT_OUT):
                yield module.name


def own_parameters(function):
    try:
        parameters = list(inspect.signature(function).parameters.values())
    except (TypeError, ValueError):
        return []
    return [parameter for parameter in parameters if parameter.name not in ('self', 'cls')]


def add(arguments, name, required=False, positional=False):
    if name not in [argument['name'] for argument in arguments]:
        arguments.append({'name': name, 'required': required, 'positional': positional})


def add_arguments(functions, arguments):
    """Those of the first function, and of the next one if it takes further ones by **kwargs. Returns whether there are no others."""
    for number, function in enumerate(functions):
        more = False
        for parameter in own_parameters(function):
            if parameter.kind is parameter.VAR_KEYWORD:
                more = parameter.name != 'unknown'  # which are refused
            elif parameter.kind is not parameter.VAR_POSITIONAL and is_public(parameter.name):
                # What a derived class fills in itself is positional in the base.
                if number == 0 or parameter.kind is parameter.KEYWORD_ONLY or parameter.default is not parameter.empty:
                    add(arguments, parameter.name, parameter.default is parameter.empty,
                        parameter.kind is parameter.POSITIONAL_OR_KEYWORD and number == 0)
        if not more:
            return True
    return False


def arguments_of(value):
    """The list of arguments, and whether it has all of them."""
    arguments = []
    if not inspect.isclass(value):
        return arguments, add_arguments([value], arguments)
    functions = [base.__init__ for base in value.__mro__ if '__init__' in base.__dict__ and base is not object]
    complete = add_arguments(functions, arguments) or not functions
    options = getattr(value, '_ARGUMENTS', None)  # of an action that runs a process
    if options is not None:
        for name in (*options, *value._EXTENSIONS, 'depends_on', 'watch'):
            add(arguments, name)
        complete = True
    return arguments, complete


def entry_of(value):
    text = inspect.getdoc(value) if '__doc__' in getattr(value, '__dict__', {}) and value.__doc__ else ''
    entry = {'kind': 'class' if inspect.isclass(value) else 'function' if callable(value) else 'value', 'help': text or ''}
    if callable(value):
        entry['arguments'], entry['complete'] = arguments_of(value)
    entry['tag'] = TAGS.get(getattr(value, '__name__', ''), '')
    return entry


def names_of(module):
    listed = getattr(module, '__all__', None) or [name for name in dir(module) if is_public(name)]
    names = {}
    for name in sorted(set(listed)):
        value = getattr(module, name, None)
        home = getattr(value, '__module__', None) or ''
        if inspect.ismodule(value) or not home.split('.')[0] in PACKAGES:
            continue
        names[name] = entry_of(value)
    return names


def main():
    sys.path.insert(0, sys.argv[1])
    table = {}
    for name in sorted(set(modules())):
        try:
            table[name] = names_of(importlib.import_module(name))
        except ImportError:
            continue  # needs a package that is not there
    with open(sys.argv[2], 'w', encoding='utf-8') as file:
        json.dump(table, file, indent=0, sort_keys=True)


main()
