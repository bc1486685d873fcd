"""Import names: the one-class modules of ROS 2's packages, and a clear error for names that don't exist here."""

import difflib
import re
import sys


class UnknownName(ImportError):
    """A name of ROS 2's packages, or of none, that this launcher doesn't have."""

    def __init__(self, message, help_=''):
        super().__init__(message)
        self.help = help_


def same_module(module, *names):
    """Makes a module importable by other names as well."""
    for name in names:
        sys.modules[name] = sys.modules[module]


def snake_case(name):
    name = re.sub('([a-z0-9])([A-Z])', r'\1_\2', name.replace('ROS', 'Ros'))
    return re.sub('([A-Z]+)([A-Z][a-z])', r'\1_\2', name).lower()


def finish(module_name, one_class_modules=False):
    """
    Answers for names that the module lacks.

    With `one_class_modules`, each class can be imported from a module of its own, too, as in
    `from launch.actions.execute_process import ExecuteProcess`.
    """
    module = sys.modules[module_name]
    if one_class_modules:
        for name, value in list(vars(module).items()):
            if isinstance(value, type) and name[0] != '_':
                sys.modules.setdefault(f'{module_name}.{snake_case(name)}', module)

    def unknown(name):
        if name[:2] == '__':
            raise AttributeError(name)
        known = [known for known in vars(module) if known[0] != '_']
        near = difflib.get_close_matches(name, known, 1)
        raise UnknownName(f"this launcher's {module_name} has no '{name}'",
                          f"did you mean '{near[0]}'?" if near else '')

    module.__getattr__ = unknown
