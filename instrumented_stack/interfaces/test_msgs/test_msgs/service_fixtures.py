# SPDX-License-Identifier: Apache-2.0
"""Requests of each service of test_msgs with their responses, for tests.

The values are those of ROS 2, so tests that expect them pass. test_msgs/service_fixtures.hpp has the same in C++.
"""

from test_msgs.message_fixtures import digits, set_arrays
from test_msgs.srv import Arrays, BasicTypes, Empty

_NUMBERS = ('int8', 'uint8', 'int16', 'uint16', 'int32', 'uint32', 'int64', 'uint64')


def get_msg_empty():
    return [[Empty.Request(), Empty.Response()]]


def _set_counted(part, factor):
    """The integers are 1, 2, … times `factor`."""
    part.bool_value, part.byte_value, part.char_value = True, bytes([factor]), factor
    part.float32_value, part.float64_value = factor + 0.125, float(f'{factor}.11')
    for index, name in enumerate(_NUMBERS):
        setattr(part, f'{name}_value', (index + 1) * factor)
    part.string_value = digits(20000)


def get_msg_basic_types():
    zeros = [BasicTypes.Request(string_value='request'), BasicTypes.Response(string_value='reply')]
    counted = [BasicTypes.Request(), BasicTypes.Response()]
    _set_counted(counted[0], 1)
    _set_counted(counted[1], 11)
    return [zeros, counted]


def get_msg_arrays():
    """The response is the request with the first two elements of each array exchanged."""
    request, response = Arrays.Request(), Arrays.Response()
    set_arrays(request)
    set_arrays(response)
    for name in ('bool', 'byte', 'char', 'float32', 'float64', *_NUMBERS, 'string', 'basic_types'):
        values = list(getattr(response, f'{name}_values'))
        setattr(response, f'{name}_values', [values[1], values[0], values[2]])
    return [[request, response]]


_SERVICES = {'Arrays': get_msg_arrays, 'BasicTypes': get_msg_basic_types, 'Empty': get_msg_empty}


def get_test_srv(service_name):
    """The requests and responses of the service with this name. Raises NotImplementedError for another name."""
    if service_name not in _SERVICES:
        raise NotImplementedError(f"there are no requests of a service '{service_name}'")
    return _SERVICES[service_name]()
