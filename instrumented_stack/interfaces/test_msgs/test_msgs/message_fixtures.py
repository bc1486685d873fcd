# SPDX-License-Identifier: Apache-2.0
"""Messages of each type of test_msgs, for tests that send, convert or store messages.

The values are those of ROS 2, so tests that expect them pass. test_msgs/message_fixtures.hpp has the same messages in C++.
"""

from test_msgs.msg import (Arrays, BasicTypes, BoundedPlainSequences, BoundedSequences, Builtins, ComplexNestedKey, Constants,
                           Defaults, Empty, KeyedLong, KeyedString, MultiNested, Nested, NonKeyedWithNestedKey, Strings,
                           UnboundedSequences, WStrings)

_SIZES = (8, 16, 32, 64)


def int_from_uint(value, nbits):
    """The signed number with the lowest bits of an unsigned one."""
    value %= 1 << nbits
    return value - (1 << nbits) if value >> (nbits - 1) else value


def digits(count):
    return ''.join(str(index % 10) for index in range(count))


def _bytes(*values):
    return [bytes([value]) for value in values]


def _set(message, suffix, values):
    """Sets a field for each kind of number: values(the kind's smallest number, its largest one)."""
    for size in _SIZES:
        setattr(message, f'int{size}{suffix}', values(-(1 << (size - 1)), (1 << (size - 1)) - 1))
        setattr(message, f'uint{size}{suffix}', values(0, (1 << size) - 1))


def _floats(message, suffix, value):
    setattr(message, f'float32{suffix}', value)
    setattr(message, f'float64{suffix}', value)


def _repeated(messages, count=3):
    return [messages[index % len(messages)] for index in range(count)]


def get_msg_empty():
    return [Empty()]


def get_msg_constants():
    return [Constants()]


def get_msg_defaults():
    return [Defaults()]


def get_msg_builtins():
    message = Builtins()
    message.duration_value.sec = message.time_value.sec = -1234567890
    message.duration_value.nanosec = 123456789
    message.time_value.nanosec = 987654321
    return [message]


def get_msg_basic_types():
    """All zero, the largest values, the smallest ones, all one."""
    messages = []
    for flag, byte, real, number in ((False, 0, 0.0, lambda least, most: 0), (True, 255, 1.125, lambda least, most: most),
                                     (False, 0, -2.125, lambda least, most: least), (True, 1, 1.0, lambda least, most: 1)):
        message = BasicTypes(bool_value=flag, byte_value=bytes([byte]), char_value=byte)
        _floats(message, '_value', real)
        _set(message, '_value', number)
        messages.append(message)
    return messages


def get_msg_strings():
    texts = [(text, text) for text in ('', 'Hello world!', 'Hell\u00f6 W\u00f6rld!')] + [(digits(20000), digits(22))]
    return [Strings(string_value=text, bounded_string_value=bounded) for text, bounded in texts]


def get_msg_nested():
    return [Nested(basic_types_value=message) for message in get_msg_basic_types()]


def _three(message, bytes_in_order, numbers):
    message.bool_values = [False, True, False]
    message.byte_values = _bytes(*bytes_in_order)
    message.char_values = list(bytes_in_order)
    _floats(message, '_values', [0.0, 1.125, -2.125])
    _set(message, '_values', numbers)


def set_arrays(message):
    """The values of Arrays, also for its service."""
    _three(message, (0, 255, 0), lambda least, most: [0, most, least])
    message.string_values = ['', 'max value', 'min value']
    message.basic_types_values = get_msg_basic_types()[:3]


def get_msg_arrays():
    message = Arrays()
    set_arrays(message)
    return [message]


def get_msg_unbounded_sequences():
    """Empty, with one element, with two or three, with 1000, and with the default of each field."""
    basic_types = get_msg_basic_types()
    messages = [UnboundedSequences(alignment_check=index) for index in range(5)]

    one = messages[1]
    one.bool_values, one.byte_values, one.char_values = [True], _bytes(255), [255]
    _floats(one, '_values', [1.125])
    _set(one, '_values', lambda least, most: [most])
    one.string_values = ['max value']
    one.basic_types_values = basic_types[:1]

    few = messages[2]
    few.bool_values, few.byte_values, few.char_values = [False, True], _bytes(0, 255), [0, 255]
    _floats(few, '_values', [0.0, 1.125, -2.125])
    _set(few, '_values', lambda least, most: [0, most, least] if least else [0, most])
    few.string_values = ['', 'max value', 'optional min value']
    few.basic_types_values = _repeated(basic_types)

    many = messages[3]
    numbers = range(1000)
    many.bool_values = [number % 2 != 0 for number in numbers]
    many.byte_values = _bytes(*(number % 256 for number in numbers))
    many.char_values = [number % 256 for number in numbers]
    _floats(many, '_values', [1.125 * number for number in numbers])
    for size in _SIZES:
        setattr(many, f'int{size}_values', [int_from_uint(number, size) for number in numbers])
        setattr(many, f'uint{size}_values', [number % (1 << size) for number in numbers])
    many.string_values = [str(number) for number in numbers]
    many.basic_types_values = _repeated(basic_types, len(numbers))
    return messages


def _bounded(message):
    _three(message, (0, 1, 255), lambda least, most: [0, most, least] if least else [0, 1, most])
    message.basic_types_values = _repeated(get_msg_basic_types())
    message.alignment_check = 2
    return message


def get_msg_bounded_sequences():
    message = _bounded(BoundedSequences())
    message.string_values = ['', 'max value', 'optional min value']
    return [message, BoundedSequences(alignment_check=4)]


def get_msg_bounded_plain_sequences():
    return [_bounded(BoundedPlainSequences()), BoundedPlainSequences(alignment_check=4)]


def get_msg_multi_nested():
    message = MultiNested()
    parts = {'arrays': get_msg_arrays(), 'bounded_sequences': get_msg_bounded_sequences(),
             'unbounded_sequences': get_msg_unbounded_sequences()}
    for container in ('array', 'bounded_sequence', 'unbounded_sequence'):
        for name, messages in parts.items():
            setattr(message, f'{container}_of_{name}', _repeated(messages))
    return [message]


def get_msg_wstrings():
    """The words for one, two and four in Japanese, an umlaut, and a text in Katakana are in them."""
    texts = ('', 'ascii', 'Hell\u00f6 W\u00f6rld!', '\u30cf\u30ed\u30fc\u30ef\u30fc\u30eb\u30c9')
    messages = [WStrings(wstring_value=text) for text in texts]
    messages[0].array_of_wstrings = ['1', 'two', '\u4e09']
    messages[0].bounded_sequence_of_wstrings = ['one', '\u4e8c']
    messages[0].unbounded_sequence_of_wstrings = ['.', '..', '...', '\u56db']
    return messages


def get_msg_keyed_long():
    return [KeyedLong(key=number, value=number) for number in (1, 2)]


def get_msg_keyed_string():
    return [KeyedString(key=f'key_{number}', value=f'value_{number}') for number in (1, 2)]


def get_msg_non_keyed_with_nested_key():
    return [NonKeyedWithNestedKey(nested_data=message, some_int=-1) for message in get_msg_keyed_string()]


def get_msg_complex_nested_key():
    return [ComplexNestedKey(nested_keys=message, uint32_key=3, float64_value=1.125)
            for message in get_msg_non_keyed_with_nested_key()]


_MESSAGES = {
    'Arrays': get_msg_arrays, 'BasicTypes': get_msg_basic_types, 'BoundedPlainSequences': get_msg_bounded_plain_sequences,
    'BoundedSequences': get_msg_bounded_sequences, 'Builtins': get_msg_builtins,
    'ComplexNestedKey': get_msg_complex_nested_key, 'Constants': get_msg_constants, 'Defaults': get_msg_defaults,
    'Empty': get_msg_empty, 'KeyedLong': get_msg_keyed_long, 'KeyedString': get_msg_keyed_string,
    'MultiNested': get_msg_multi_nested, 'Nested': get_msg_nested,
    'NonKeyedWithNestedKey': get_msg_non_keyed_with_nested_key, 'Strings': get_msg_strings,
    'UnboundedSequences': get_msg_unbounded_sequences, 'WStrings': get_msg_wstrings}


def get_test_msg(message_name):
    """The messages of the type with this name. Raises NotImplementedError for another name."""
    if message_name not in _MESSAGES:
        raise NotImplementedError(f"there are no messages of a type '{message_name}'")
    return _MESSAGES[message_name]()
