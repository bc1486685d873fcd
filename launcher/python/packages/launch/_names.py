# SPDX-License-Identifier: Apache-2.0
"""The names of those modules of ROS 2's packages that hold one class each."""

import sys


def same_module(module, *names):
    """Makes a module importable by other names as well. It is an attribute of their packages, too, as in ROS 2."""
    for name in names:
        sys.modules[name] = sys.modules[module]
        _set_attribute(name)


def _set_attribute(name):
    package, _, last = name.rpartition('.')
    if package in sys.modules and last not in vars(sys.modules[package]):
        setattr(sys.modules[package], last, sys.modules[name])


def snake_case(name):
    """Turns ExecuteProcess into execute_process, and SetROSLogDir into set_ros_log_dir."""
    result = ''
    for index, character in enumerate(name):
        before, after = name[index - 1:index], name[index + 1:index + 2]
        if character.isupper() and before and (not before.isupper() or after.islower()):
            result += '_'
        result += character.lower()
    return result


def one_class_modules(module_name):
    """
    Makes each class of the module importable from a module of its own, too.

    `from launch.actions.execute_process import ExecuteProcess` then works as in ROS 2.
    """
    module = sys.modules[module_name]
    for name, value in list(vars(module).items()):
        if isinstance(value, type) and name[0] != '_':
            own_module = f'{module_name}.{snake_case(name)}'
            sys.modules.setdefault(own_module, module)
            _set_attribute(own_module)
