# SPDX-License-Identifier: Apache-2.0
"""The parsing methods of the launcher's own actions, for parsers and front ends that packages write in Python."""

from functools import partial
from importlib import import_module

_CORE = {'arg': 'DeclareLaunchArgument', 'append_env': 'AppendEnvironmentVariable', 'executable': 'ExecuteProcess',
         'for': 'ForLoop', 'for_each': 'ForEach', 'group': 'GroupAction', 'include': 'IncludeLaunchDescription',
         'let': 'SetLaunchConfiguration', 'log': 'Log', 'log_debug': 'LogDebug', 'log_error': 'LogError',
         'log_info': 'LogInfo', 'log_warning': 'LogWarning', 'rep_env': 'ReplaceEnvironmentVariables',
         'reset': 'ResetLaunchConfigurations', 'reset_env': 'ResetEnvironment', 'set_env': 'SetEnvironmentVariable',
         'shutdown': 'Shutdown', 'timer': 'TimerAction', 'unset': 'UnsetLaunchConfiguration',
         'unset_env': 'UnsetEnvironmentVariable'}
_ROS = {'lifecycle_node': 'LifecycleNode', 'load_composable_node': 'LoadComposableNodes', 'node': 'Node',
        'node_container': 'ComposableNodeContainer', 'push-ros-namespace': 'PushRosNamespace',
        'push_ros_namespace': 'PushRosNamespace', 'ros_timer': 'RosTimer', 'set_parameter': 'SetParameter',
        'set_parameters_from_file': 'SetParametersFromFile', 'set_remap': 'SetRemap', 'set_ros_log_dir': 'SetROSLogDir',
        'set_use_sim_time': 'SetUseSimTime'}


def _parse(module, cls, entity, parser):
    return getattr(import_module(module), cls).parse(entity, parser)


# The modules are imported when one of their elements is parsed.
METHODS = {tag: partial(_parse, module, cls) for module, classes in (
    ('launch.actions', _CORE), ('launch_ros.actions', _ROS), ('tracetools_launch.action', {'trace': 'Trace'}))
    for tag, cls in classes.items()}
