# SPDX-License-Identifier: Apache-2.0
"""What the modules of a package call that its build writes: <package>.msg._string and <package>.msg."""

import sys
from importlib import import_module
from os.path import abspath, dirname, exists, join
from typing import Any, Callable, List, Mapping, Tuple

from rosidl_pycommon.interface_base_classes import (
    ActionTypeSupportMeta, BaseAction, BaseImpl, BaseService, ServiceTypeSupportMeta)

from ._field_types import FieldType, class_of, field_type
from ._messages import message_class


class Definitions:
    """Makes the classes of one file, such as String.msg."""

    def __init__(self, module: str, file: str, library: str):
        """`library` is the package's library for C, from the folder of `file`, which is the module's."""
        self._module = module
        self._package, self._namespace, _ = module.split('.')
        self._library = join(dirname(abspath(file)), library)

    def message(self, name: str, fields: Mapping[str, str], defaults: Mapping[str, Any] = {},
                constants: Mapping[str, Any] = {}) -> Tuple[type, Any]:
        """The metaclass and the class."""
        def import_type_support(metaclass: Any) -> None:
            (metaclass._CREATE_ROS_MESSAGE, metaclass._CONVERT_FROM_PY, metaclass._CONVERT_TO_PY,
             metaclass._DESTROY_ROS_MESSAGE, metaclass._TYPE_SUPPORT) = self._native().message(
                 self._loaded_library(), self._symbol(name))
            for text in fields.values():
                type_: FieldType = field_type(text)
                if type_.is_message:
                    _import(type_.message)

        return message_class(self._module, name, fields, defaults, constants, import_type_support)

    def service(self, name: str, request: Any, response: Any, event: Any) -> Tuple[type, Any]:
        """The metaclass and the class of the service of these messages."""
        return self._compound('service', name, (ServiceTypeSupportMeta, BaseService),
                              {'Request': request, 'Response': response, 'Event': event}, [request, response, event])

    def action(self, name: str, goal: Any, result: Any, feedback: Any, send_goal: Any, get_result: Any,
               feedback_message: Any) -> Tuple[type, Any]:
        """The metaclass and the class of the action of these messages and services."""
        cancel_goal = class_of('action_msgs/srv/CancelGoal')
        status = class_of('action_msgs/msg/GoalStatusArray')
        impl = type(BaseImpl)('Impl', (BaseImpl,), {
            '__module__': self._module, '__qualname__': f'{name}.Impl', 'SendGoalService': send_goal,
            'GetResultService': get_result, 'FeedbackMessage': feedback_message, 'CancelGoalService': cancel_goal,
            'GoalStatusMessage': status})
        return self._compound('action', name, (ActionTypeSupportMeta, BaseAction),
                              {'Goal': goal, 'Result': result, 'Feedback': feedback, 'Impl': impl},
                              [status, cancel_goal, send_goal, get_result, feedback_message])

    def _compound(self, kind: str, name: str, bases: Tuple[type, type], attributes: Mapping[str, Any], parts: List[Any]
                  ) -> Tuple[type, Any]:
        def import_type_support(metaclass: Any) -> None:
            metaclass._TYPE_SUPPORT = self._native().interface(self._loaded_library(), kind, self._symbol(name))
            for part in parts:
                _import(part)

        def __init__(instance: Any) -> None:
            raise NotImplementedError(f'{kind.capitalize()} classes can not be instantiated')

        base_of_metaclass, base = bases
        metaclass = type(f'Metaclass_{name}', (base_of_metaclass,), {
            '__module__': self._module, '__doc__': f"Metaclass of {kind} '{name}'.", '_TYPE_SUPPORT': None,
            '__import_type_support__': classmethod(import_type_support)})
        return metaclass, metaclass(name, (base,), {'__module__': self._module, '__qualname__': name, '__init__': __init__,
                                                   **attributes})

    def _symbol(self, name: str) -> str:
        return f'{self._package}__{self._namespace}__{name}'

    def _loaded_library(self) -> str:
        if not exists(self._library):
            raise ImportError(f'{self._module}: there is no library {self._library}, which has the type support of its '
                              'classes', name=self._module)
        return self._library

    def _native(self) -> Any:
        try:
            return import_module('rosidl_generator_py._type_support')
        except ModuleNotFoundError as error:
            if error.name != 'rosidl_generator_py._type_support':
                raise
            raise ImportError('rosidl_generator_py was built without its extension module for this Python, so messages '
                              'cannot be sent (Debian: python3-dev for its build)', name=error.name) from error


def _import(class_: Any) -> None:
    if type(class_)._TYPE_SUPPORT is None:
        class_.__import_type_support__()


def interface_module(module: str, classes: Mapping[str, str]
                     ) -> Tuple[List[str], Callable[[str], Any], Callable[[], List[str]]]:
    """`__all__`, `__getattr__` and `__dir__` of <package>.msg, which imports a class when it is asked for.

    `classes` tells the module of each class, such as '_string'.
    """
    def __getattr__(name: str) -> Any:
        if name in classes:
            value = getattr(import_module(f'{module}.{classes[name]}'), name)
        elif name in classes.values():
            value = import_module(f'{module}.{name}')
        else:
            raise AttributeError(f"module '{module}' has no attribute '{name}'")
        setattr(sys.modules[module], name, value)
        return value

    def __dir__() -> List[str]:
        return sorted({*vars(sys.modules[module]), *classes})

    return list(classes), __getattr__, __dir__
