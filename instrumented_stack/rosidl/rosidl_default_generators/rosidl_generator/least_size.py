# SPDX-License-Identifier: Apache-2.0
"""The least number of bytes that a message has in CDR, by its description.

A sequence in received bytes cannot have more elements than the bytes that remain have room for, so no memory is made for
a length that is wrong. Bytes for alignment are not counted.
"""

from typing import Dict, Mapping

from .type_hash import ARRAY, BOUNDED_SEQUENCE, NESTED_TYPE, TYPE_IDS, Description

LENGTH = 4
SIZES = {**{TYPE_IDS[f'{sign}int{bits}']: bits // 8 for sign in ('', 'u') for bits in (8, 16, 32, 64)},
         TYPE_IDS['float32']: 4, TYPE_IDS['float64']: 8, TYPE_IDS['idl_char']: 1, TYPE_IDS['bool']: 1,
         TYPE_IDS['byte']: 1}


def least_sizes(descriptions: Mapping[str, Description]) -> Dict[str, int]:
    """By the names of the types. `descriptions` has those of all messages in them, too."""
    sizes: Dict[str, int] = {}

    def size_of(name: str) -> int:
        if name not in sizes:
            sizes[name] = sum(_field(field['type'], size_of) for field in descriptions[name]['fields'])
        return sizes[name]

    for name in descriptions:
        size_of(name)
    return sizes


def _field(type_: Description, size_of) -> int:
    type_id = type_['type_id']
    if type_id > BOUNDED_SEQUENCE:
        return LENGTH
    count = type_['capacity'] if type_id > ARRAY else 1
    element = type_id - ARRAY if type_id > ARRAY else type_id
    if element == NESTED_TYPE:
        return count * size_of(type_['nested_type_name'])
    return count * SIZES.get(element, LENGTH)
