# SPDX-License-Identifier: Apache-2.0
"""The messages and services of test_msgs that packages take for their tests, in Python."""

import unittest

from ros_messages import Conversion
from test_msgs import message_fixtures
from test_msgs.message_fixtures import get_test_msg, int_from_uint
from test_msgs.service_fixtures import get_test_srv

NUMBERS = {'Arrays': 1, 'BasicTypes': 4, 'BoundedPlainSequences': 2, 'BoundedSequences': 2, 'Builtins': 1, 'ComplexNestedKey': 2,
           'Constants': 1, 'Defaults': 1, 'Empty': 1, 'KeyedLong': 2, 'KeyedString': 2, 'MultiNested': 1, 'Nested': 4,
           'NonKeyedWithNestedKey': 2, 'Strings': 4, 'UnboundedSequences': 5, 'WStrings': 4}


class Fixtures(unittest.TestCase):
    def test_each_message_can_be_sent(self):
        self.assertEqual({name: len(get_test_msg(name)) for name in NUMBERS}, NUMBERS)
        for name in NUMBERS:
            for message in get_test_msg(name):
                conversion = Conversion(type(message))
                self.assertEqual(conversion.message_of(conversion.bytes_of(message)), message, name)

    def test_values(self):
        basic_types = get_test_msg('BasicTypes')
        self.assertEqual((basic_types[1].int64_value, basic_types[1].byte_value), ((1 << 63) - 1, b'\xff'))
        self.assertEqual((basic_types[2].int8_value, basic_types[2].float32_value), (-128, -2.125))
        few, many = get_test_msg('UnboundedSequences')[2:4]
        self.assertEqual((list(few.uint16_values), list(few.int16_values)), ([0, 65535], [0, 32767, -32768]))
        self.assertEqual((many.int8_values[200], many.string_values[999]), (-56, '999'))
        self.assertEqual(list(get_test_msg('Arrays')[0].uint8_values), [0, 255, 0])
        self.assertEqual(list(get_test_msg('BoundedSequences')[0].uint8_values), [0, 1, 255])
        self.assertEqual(get_test_msg('ComplexNestedKey')[1].nested_keys.nested_data.key, 'key_2')
        self.assertEqual([int_from_uint(value, 8) for value in (127, 128, 256)], [127, -128, 0])
        with self.assertRaisesRegex(NotImplementedError, "^there are no messages of a type 'Array'$"):
            get_test_msg('Array')
        self.assertEqual(message_fixtures.get_msg_keyed_long()[1].value, 2)

    def test_services(self):
        self.assertEqual([len(get_test_srv(name)) for name in ('Arrays', 'BasicTypes', 'Empty')], [1, 2, 1])
        request, response = get_test_srv('BasicTypes')[1]
        self.assertEqual((request.float64_value, response.float64_value, response.uint64_value), (1.11, 11.11, 88))
        request, response = get_test_srv('Arrays')[0]
        self.assertEqual((request.string_values[:2], response.string_values[:2]), (['', 'max value'], ['max value', '']))
        with self.assertRaisesRegex(NotImplementedError, "^there are no requests of a service 'Array'$"):
            get_test_srv('Array')


if __name__ == '__main__':
    unittest.main()
