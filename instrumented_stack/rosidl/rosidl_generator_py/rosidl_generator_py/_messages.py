# SPDX-License-Identifier: Apache-2.0
"""Makes a class of messages of a table of its fields."""

import os
from typing import Any, Callable, Dict, List, Mapping, Tuple

from rosidl_pycommon.interface_base_classes import BaseMessage, MessageTypeSupportMeta

from ._checks import check_of, kept_as_it_is
from ._field_types import FieldType, field_type, numpy

# Messages check what their fields are given only on demand, as in ROS 2 since Jazzy.
CHECK_FIELDS = os.environ.get('ROS_PYTHON_CHECK_FIELDS', '') == '1'


def message_class(module: str, name: str, fields: Mapping[str, str], defaults: Mapping[str, Any],
                  constants: Mapping[str, Any], import_type_support: Callable[[Any], None]) -> Tuple[type, Any]:
    """The metaclass and the class of a message.

    `fields` tells their types as FieldType reads them. `import_type_support` gets the metaclass and fills its capsules.
    """
    types = {field: field_type(text) for field, text in fields.items()}
    shown = {**constants, **{f'{field.upper()}__DEFAULT': types[field].default(value)() for field, value in defaults.items()}}
    metaclass = _metaclass(module, name, shown, import_type_support)
    namespace: Dict[str, Any] = {
        '__module__': module, '__qualname__': name, '__doc__': _documentation(name, constants),
        '__slots__': [*(f'_{field}' for field in fields), '_check_fields'],
        '_fields_and_field_types': {field: type_.text for field, type_ in types.items()},
        'SLOT_TYPES': tuple(type_.slot_type() for type_ in types.values()),
        **_METHODS, **shown}
    class_ = metaclass(name, (BaseMessage,), namespace)
    new_values = []
    for field, type_ in types.items():
        store = class_.__dict__[f'_{field}'].__set__
        load = class_.__dict__[f'_{field}'].__get__
        setattr(class_, field, property(load, _setter(field, type_, store), doc=f"Message field '{field}'."))
        new_values.append((field, type_, store, type_.default(defaults.get(field))))
    class_.__init__ = _constructor(frozenset(fields), new_values)
    return metaclass, class_


def _metaclass(module: str, name: str, shown: Mapping[str, Any], import_type_support: Callable[[Any], None]) -> type:
    def constant(key: str) -> property:
        return property(lambda class_: shown[key], doc=f"Constant or default '{key}'.")

    return type(f'Metaclass_{name}', (MessageTypeSupportMeta,), {
        '__module__': module, '__doc__': f"Metaclass of message '{name}'.", '_CREATE_ROS_MESSAGE': None,
        '_CONVERT_FROM_PY': None, '_CONVERT_TO_PY': None, '_DESTROY_ROS_MESSAGE': None, '_TYPE_SUPPORT': None,
        '__import_type_support__': classmethod(import_type_support), **{key: constant(key) for key in shown}})


def _documentation(name: str, constants: Mapping[str, Any]) -> str:
    if not constants:
        return f"Message class '{name}'."
    return f"Message class '{name}'.\n\nConstants:\n" + ''.join(f'  {constant}\n' for constant in constants)


def _setter(field: str, type_: FieldType, store: Callable[[Any, Any], None]) -> Callable[[Any, Any], None]:
    check = check_of(field, type_)
    if type_.type_code is None:
        def set_value(self: Any, value: Any) -> None:
            if self._check_fields:
                check(value)
            store(self, value)
    else:
        def set_value(self: Any, value: Any) -> None:
            if self._check_fields and not kept_as_it_is(field, type_, value):
                check(value)
                value = type_.convert(value)
            elif not self._check_fields:
                value = type_.convert(value)
            store(self, value)
    return set_value


def _constructor(fields: frozenset, new_values: List[Tuple[str, FieldType, Callable[[Any, Any], None], Callable[[], Any]]]
                 ) -> Callable[..., None]:
    def __init__(self: Any, **kwargs: Any) -> None:
        check = kwargs.pop('check_fields', CHECK_FIELDS)
        self._check_fields = check
        if check:
            assert fields.issuperset(kwargs), \
                'Invalid arguments passed to constructor: ' + ', '.join(sorted(set(kwargs) - fields))
        for field, type_, store, default in new_values:
            value = kwargs.get(field) if kwargs else None
            if value is None:
                store(self, default())
                continue
            if type_.type_code is not None:
                value = type_.convert(value)
                assert type_.size is None or value.shape == (type_.size,), f"The '{field}' field must have {type_.size} values"
            setattr(self, field, value)

    return __init__


def _repr(self: Any) -> str:
    arguments = []
    for field, text in self._fields_and_field_types.items():
        value = getattr(self, field)
        shown = repr(value)
        if text.startswith('sequence<') and shown.startswith('array('):
            shown = repr(list(value))
        arguments.append(f'{field}={shown}')
    module = type(self).__module__.rsplit('.', 1)[0]
    return f"{module}.{type(self).__name__}({', '.join(arguments)})"


def _equal(self: Any, other: Any) -> bool:
    if not isinstance(other, type(self)):
        return False
    for field, text in self._fields_and_field_types.items():
        one, another = getattr(self, field), getattr(other, field)
        if text.endswith(']') and not isinstance(one, list):
            if not numpy().array_equal(one, another):
                return False
        elif one != another:
            return False
    return True


def _get_fields_and_field_types(cls: Any) -> Dict[str, str]:
    return dict(cls._fields_and_field_types)


_METHODS = {'__repr__': _repr, '__eq__': _equal, '__hash__': None,
            'get_fields_and_field_types': classmethod(_get_fields_and_field_types)}
