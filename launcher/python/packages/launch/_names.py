"""The import names of ROS 2's packages that hold one class each."""

import re
import sys


def same_module(module, *names):
    """Makes a module importable by other names as well."""
    for name in names:
        sys.modules[name] = sys.modules[module]


def snake_case(name):
    name = re.sub('([a-z0-9])([A-Z])', r'\1_\2', name.replace('ROS', 'Ros'))
    return re.sub('([A-Z]+)([A-Z][a-z])', r'\1_\2', name).lower()


def one_class_modules(module_name):
    """
    Each class of the module can be imported from a module of its own, too.

    So that `from launch.actions.execute_process import ExecuteProcess` means what it means in ROS 2.
    """
    module = sys.modules[module_name]
    for name, value in list(vars(module).items()):
        if isinstance(value, type) and name[0] != '_':
            sys.modules.setdefault(f'{module_name}.{snake_case(name)}', module)
