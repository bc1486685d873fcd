# SPDX-License-Identifier: Apache-2.0
"""Emits the modules of a package in Python: <package>/msg/_string.py tells what rosidl_generator_py makes the classes of."""

from typing import Any, Dict, List

from .interface_definition import InterfaceFile, Message, Type, snake_case

# The names that ROS 2 gives types in Python are those of IDL.
PRIMITIVES = {'bool': 'boolean', 'byte': 'octet', 'char': 'uint8', 'idl_char': 'char', 'float32': 'float',
              'float64': 'double'}
LICENSE_LINE = '# SPDX-License-Identifier: Apache-2.0\n'


def modules(package: str, files: List[InterfaceFile], library: str) -> Dict[str, str]:
    """The text of each module, by its path. `library` is the package's library for C, from the folder of the modules."""
    texts = {f'{package}/__init__.py': ''}
    for namespace in sorted({file.namespace for file in files}):
        own = [file for file in files if file.namespace == namespace]
        texts[f'{package}/{namespace}/__init__.py'] = _init(own)
        for file in own:
            texts[f'{package}/{namespace}/{_module(file)}.py'] = _file(file, library)
    return texts


def _module(file: InterfaceFile) -> str:
    return f'_{snake_case(file.name)}'


def _classes(file: InterfaceFile) -> List[str]:
    named = [interface.name for interface in (*file.messages, *file.services)]
    return [*named, file.action.name] if file.action else named


def _init(files: List[InterfaceFile]) -> str:
    classes = {name: _module(file) for file in files for name in _classes(file)}
    rows = ''.join(f'    {name!r}: {module!r},\n' for name, module in sorted(classes.items()))
    return (f'{LICENSE_LINE}from rosidl_generator_py import interface_module\n\n'
            f'__all__, __getattr__, __dir__ = interface_module(__name__, {{\n{rows}}})\n')


def _file(file: InterfaceFile, library: str) -> str:
    text = (f'{LICENSE_LINE}from rosidl_generator_py import Definitions\n\n'
            f'define = Definitions(__name__, __file__, {library!r})\n')
    text += ''.join(map(_message, file.messages))
    for service in file.services:
        parts = ', '.join(message.name for message in (service.request, service.response, service.event))
        text += f'Metaclass_{service.name}, {service.name} = define.service({service.name!r}, {parts})\n'
    if file.action:
        name = file.action.name
        parts = ', '.join(f'{name}_{part}' for part in ('Goal', 'Result', 'Feedback', 'SendGoal', 'GetResult', 'FeedbackMessage'))
        text += f'Metaclass_{name}, {name} = define.action({name!r}, {parts})\n'
    return text


def _message(message: Message) -> str:
    fields = {field.name: type_text(field.type) for field in message.fields}
    defaults = ', '.join(f'{field.name!r}: {_value(field.type, field.default)}' for field in message.fields
                         if field.default is not None)
    constants = ', '.join(f'{constant.name!r}: {_value(constant.type, constant.value)}' for constant in message.constants)
    further = (f', defaults={{{defaults}}}' if defaults else '') + (f', constants={{{constants}}}' if constants else '')
    return f'Metaclass_{message.name}, {message.name} = define.message({message.name!r}, {fields!r}{further})\n'


def type_text(type_: Type) -> str:
    """'int32', 'string<8>', 'std_msgs/msg/Header', 'sequence<double, 3>' or 'float[9]'."""
    element = PRIMITIVES.get(type_.name, type_.name)
    if type_.is_message:
        element = f'{type_.package}/{type_.namespace}/{type_.name}'
    elif type_.string_bound is not None:
        element += f'<{type_.string_bound}>'
    if type_.is_array:
        return f'{element}[{type_.array_size}]'
    if type_.sequence_bound is not None:
        return f'sequence<{element}, {type_.sequence_bound}>'
    return f'sequence<{element}>' if type_.is_sequence else element


def _value(type_: Type, value: Any) -> str:
    if isinstance(value, list):
        return f"[{', '.join(_value(type_.element, item) for item in value)}]"
    if type_.name == 'byte':
        return repr(bytes([value]))
    if type_.name == 'idl_char':
        return repr(chr(value % 256))
    text = repr(value)
    return f'float({text!r})' if text in ('inf', '-inf', 'nan') else text
