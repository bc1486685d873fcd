# SPDX-License-Identifier: Apache-2.0
"""Describes interfaces as type_description_interfaces does, and hashes the descriptions (RIHS01).

The hash identifies the definition of a type. It is SHA-256 over a JSON text of its description, without defaults, and
of the descriptions of all messages in it. All ROS 2 systems have the same hash for the same definition.
"""

import hashlib
import json
from typing import Any, Dict, Iterable, List, Mapping

from .interface_definition import InterfaceFile, Message, Service, Type

# The values of type_description_interfaces/FieldType. `char` of a .msg file is an unsigned byte, as
# in its C++ type; that of an .idl file (`idl_char`) is a type of its own.
TYPE_IDS = {'int8': 2, 'uint8': 3, 'char': 3, 'int16': 4, 'uint16': 5, 'int32': 6, 'uint32': 7, 'int64': 8, 'uint64': 9,
            'float32': 10, 'float64': 11, 'idl_char': 13, 'bool': 15, 'byte': 16, 'string': 17, 'wstring': 18}
NESTED_TYPE = 1
BOUNDED_STRINGS = {'string': 21, 'wstring': 22}
ARRAY = 48
BOUNDED_SEQUENCE = 96
UNBOUNDED_SEQUENCE = 144

Description = Dict[str, Any]  # an interface: its name, and name and type of its fields


def describe_file(file: InterfaceFile) -> List[Description]:
    """Describes everything that a file defines: its messages, its services, its action."""
    descriptions = [describe(message) for message in file.messages]
    for service in file.services:
        descriptions.append(_describe_service(service))
    if file.action:
        name = f'{file.package}/action/{file.name}'
        parts = ('goal', 'Goal'), ('result', 'Result'), ('feedback', 'Feedback'), ('send_goal_service', 'SendGoal'), (
            'get_result_service', 'GetResult'), ('feedback_message', 'FeedbackMessage')
        descriptions.append({'type_name': name, 'fields': [_nested(field, f'{name}_{part}') for field, part in parts]})
    return descriptions


def describe(message: Message) -> Description:
    return {'type_name': f'{message.package}/{message.namespace}/{message.name}',
            'fields': [{'name': field.name, 'type': _describe_type(field.type)} for field in message.members]}


def _describe_service(service: Service) -> Description:
    """Describes the service as an interface of three messages."""
    name = f'{service.package}/{service.namespace}/{service.name}'
    parts = ('request_message', 'Request'), ('response_message', 'Response'), ('event_message', 'Event')
    return {'type_name': name, 'fields': [_nested(field, f'{name}_{part}') for field, part in parts]}


def _nested(field: str, type_name: str) -> Dict[str, Any]:
    return {'name': field, 'type': {'type_id': NESTED_TYPE, 'capacity': 0, 'string_capacity': 0,
                                    'nested_type_name': type_name}}


def _describe_type(type_: Type) -> Description:
    nested = ''
    if type_.is_message:
        type_id = NESTED_TYPE
        nested = f'{type_.package}/{type_.namespace}/{type_.name}'
    elif type_.string_bound is not None:
        type_id = BOUNDED_STRINGS[type_.name]
    else:
        type_id = TYPE_IDS[type_.name]
    capacity = 0
    if type_.is_array:
        type_id += ARRAY
        capacity = type_.array_size
    elif type_.sequence_bound is not None:
        type_id += BOUNDED_SEQUENCE
        capacity = type_.sequence_bound
    elif type_.is_sequence:
        type_id += UNBOUNDED_SEQUENCE
    return {'type_id': type_id, 'capacity': capacity, 'string_capacity': type_.string_bound or 0,
            'nested_type_name': nested}


def type_hash(description: Description, known: Mapping[str, Description]) -> str:
    """`known` has the descriptions of all messages in this one, by name."""
    whole = {'type_description': description,
             'referenced_type_descriptions': [known[name] for name in sorted(referenced([description], known))]}
    # The separators are part of the definition of the hash.
    text = json.dumps(whole, ensure_ascii=True, separators=(', ', ': '))
    return 'RIHS01_' + hashlib.sha256(text.encode()).hexdigest()


def referenced(descriptions: Iterable[Description], known: Mapping[str, Description]) -> List[str]:
    """Names of the messages used by these descriptions, directly or indirectly."""
    found: Dict[str, None] = {}
    waiting = list(descriptions)
    while waiting:
        for field in waiting.pop()['fields']:
            name = field['type']['nested_type_name']
            if name and name not in found:
                found[name] = None
                waiting.append(known[name])
    return list(found)
