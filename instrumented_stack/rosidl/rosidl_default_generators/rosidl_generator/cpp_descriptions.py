# SPDX-License-Identifier: Apache-2.0
"""Emits the descriptions of a package's interfaces and the text of their files, for use at run time."""

from typing import Any, Dict, List, Mapping, Union

from . import cpp_types
from .interface_definition import Action, InterfaceFile, Message, Service
from .type_hash import Description


def symbol(interface: Union[Message, Service, Action]) -> str:
    """The name of the rosidl_type_description_t of an interface."""
    return _symbol(f'{interface.package}/{interface.namespace}/{interface.name}')


def _symbol(type_name: str) -> str:
    return type_name.replace('/', '__') + '__type_description'


def definitions(files: List[InterfaceFile], descriptions: List[Description], hashes: Mapping[str, str]) -> str:
    """`descriptions` has an entry for each interface in the files."""
    sources = {f'{file.package}/{file.namespace}/{file.name}': file for file in files}
    defaults = {(f'{m.package}/{m.namespace}/{m.name}', f.name): str_of(f.default)
                for file in files for m in file.messages for f in m.fields if f.default is not None}
    used = sorted({*(d['type_name'] for d in descriptions), *(
        field['type']['nested_type_name'] for d in descriptions for field in d['fields'])} - {''})
    declarations = ''.join(f'extern const rosidl_type_description_t {_symbol(name)};\n' for name in used)
    bodies = ''.join(_definition(d, sources.get(d['type_name']), defaults, hashes[d['type_name']])
                     for d in descriptions)
    return f'extern "C" {{\n\n{declarations}\n{bodies}\n}}  // extern "C"\n'


def str_of(default: Any) -> str:
    """A default value as text, as in the description of a field."""
    if isinstance(default, list):
        return f'({", ".join(str(value) for value in default)})'
    return str(default)


def _definition(description: Description, file: Union[InterfaceFile, None], defaults: Dict[Any, str],
                type_hash: str) -> str:
    name = description['type_name']
    fields = ''.join(_field(field, defaults.get((name, field['name']), '')) for field in description['fields'])
    # A part of a file, such as the request of a service, has no text of its own.
    encoding = (file.encoding or file.namespace) if file else 'implicit'
    text = file.source if file else ''
    lines = ''.join(f'\n    {cpp_types.string_literal(line)}' for line in text.splitlines(keepends=True)) or ' ""'
    fields_symbol = name.replace('/', '__') + '__fields'
    return f'''static const rosidl_field_description_t {fields_symbol}[] = {{
{fields}}};
const rosidl_type_description_t {_symbol(name)}{{
    "{name}", "{type_hash}", {fields_symbol}, {len(description['fields'])}, "{encoding}",{lines}}};
'''


def _field(field: Dict[str, Any], default: str) -> str:
    type_ = field['type']
    nested = f'&{_symbol(type_["nested_type_name"])}' if type_['nested_type_name'] else 'nullptr'
    return (f'    {{"{field["name"]}", {type_["type_id"]}, {type_["capacity"]}, {type_["string_capacity"]}, {nested}, '
            f'{cpp_types.string_literal(default)}}},\n')
