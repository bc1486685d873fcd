# SPDX-License-Identifier: Apache-2.0
"""Classes of messages, services and actions in Python have the form of ROS 2's."""

import array
import copy
import os
import pickle
import subprocess
import sys
import unittest

import numpy
from example_interfaces.action import Fibonacci
from example_interfaces.srv import AddTwoInts
from rosidl_parser import definition
from rosidl_pycommon.interface_base_classes import BaseAction, BaseImpl, BaseMessage, BaseService
from ros_messages import Conversion
from std_msgs.msg import ByteMultiArray, Header, Int8, String, UInt8MultiArray
from test_msgs.msg import Arrays, BasicTypes, BoundedSequences, Constants, Defaults, Empty, Nested, Strings, UnboundedSequences



class ClassesTest(unittest.TestCase):
    def test_has_its_names(self):
        from std_msgs.msg import _string
        self.assertIs(_string.String, String)
        self.assertIs(_string.Metaclass_String, type(String))
        self.assertEqual((String.__module__, String.__qualname__), ('std_msgs.msg._string', 'String'))
        self.assertEqual(String.__slots__, ['_data', '_check_fields'])
        self.assertEqual(String.__doc__, "Message class 'String'.")

    def test_has_the_base_classes(self):
        self.assertTrue(issubclass(String, BaseMessage) and issubclass(AddTwoInts, BaseService) and issubclass(Fibonacci, BaseAction))
        self.assertTrue(issubclass(Fibonacci.Impl, BaseImpl) and isinstance(Fibonacci.Impl.SendGoalService.Request(), BaseMessage))

    def test_star_and_dir_have_all_classes(self):
        names = {}
        exec('from std_msgs.msg import *', names)
        self.assertIs(names['Header'], Header)
        import std_msgs.msg
        self.assertIn('UInt64MultiArray', dir(std_msgs.msg))
        with self.assertRaises(ImportError):
            exec('from std_msgs.msg import Nothing')

    def test_tells_the_types_of_its_fields(self):
        self.assertEqual(Header.get_fields_and_field_types(), {'stamp': 'builtin_interfaces/Time', 'frame_id': 'string'})
        self.assertEqual(Header.SLOT_TYPES, (definition.NamespacedType(['builtin_interfaces', 'msg'], 'Time'),
                                             definition.UnboundedString()))
        fields = {**Arrays.get_fields_and_field_types(), **BoundedSequences.get_fields_and_field_types()}
        self.assertEqual(fields['string_values'], 'sequence<string, 3>')
        self.assertEqual(Strings.get_fields_and_field_types()['bounded_string_value'], 'string<22>')
        self.assertEqual(Arrays.SLOT_TYPES[0], definition.Array(definition.BasicType('boolean'), 3))

    def test_table_of_fields_is_a_copy(self):
        Header.get_fields_and_field_types().clear()
        self.assertTrue(Header.get_fields_and_field_types())

    def test_values_by_keyword(self):
        self.assertEqual(Header(frame_id='map').frame_id, 'map')
        self.assertEqual(Header(frame_id=None).frame_id, '')
        with self.assertRaisesRegex(AssertionError, 'Invalid arguments passed to constructor: data, map'):
            Header(check_fields=True, map='map', data=1)

    def test_new_messages_have_defaults(self):
        message = Defaults()
        self.assertEqual((message.bool_value, message.byte_value, message.int8_value, message.float64_value), (True, b'2', -50, 1.125))
        self.assertEqual(Defaults.INT8_VALUE__DEFAULT, -50)
        self.assertEqual(Strings().string_value_default1, 'Hello world!')
        self.assertIsNot(UnboundedSequences().string_values_default, UnboundedSequences().string_values_default)

    def test_constants_are_of_class_and_object(self):
        self.assertEqual((Constants.INT32_CONST, Constants().INT32_CONST, Constants.BYTE_CONST), (-30000, -30000, b'2'))
        with self.assertRaises(AttributeError):
            Constants.INT32_CONST = 3

    def test_numbers_are_in_arrays(self):
        self.assertIsInstance(Arrays().float32_values, numpy.ndarray)
        self.assertEqual(Arrays().float32_values.dtype, numpy.float32)
        self.assertEqual(UnboundedSequences().uint16_values, array.array('H'))
        self.assertEqual(UnboundedSequences(uint16_values=[1, 2]).uint16_values, array.array('H', [1, 2]))
        self.assertEqual(UInt8MultiArray(data=b'\1\2').data, array.array('B', [1, 2]))
        self.assertEqual(ByteMultiArray(data=[b'\1']).data, [b'\1'])

    def test_text_of_an_object(self):
        self.assertEqual(repr(Header(frame_id='map')),
                         "std_msgs.msg.Header(stamp=builtin_interfaces.msg.Time(sec=0, nanosec=0), frame_id='map')")
        self.assertEqual(repr(Fibonacci.Result(sequence=[1, 2])), 'example_interfaces.action.Fibonacci_Result(sequence=[1, 2])')
        self.assertEqual(repr(AddTwoInts.Request(a=1)), 'example_interfaces.srv.AddTwoInts_Request(a=1, b=0)')
        self.assertEqual(repr(Empty()), 'test_msgs.msg.Empty()')

    def test_compares_values(self):
        self.assertEqual(String(data='a'), String(data='a'))
        self.assertNotEqual(String(data='a'), String(data='b'))
        self.assertNotEqual(String(), Header())
        first, second = Arrays(), Arrays()
        second.int16_values[1] = 7
        self.assertNotEqual(first, second)
        with self.assertRaises(TypeError):
            hash(String())

    def test_copies(self):
        message = Nested(basic_types_value=BasicTypes(int8_value=3))
        other = copy.deepcopy(message)
        other.basic_types_value.int8_value = 4
        self.assertEqual(message.basic_types_value.int8_value, 3)
        self.assertEqual(pickle.loads(pickle.dumps(message)), message)

    def test_services_and_actions_have_their_parts(self):
        self.assertEqual([part.__name__ for part in (AddTwoInts.Request, AddTwoInts.Response, AddTwoInts.Event)],
                         ['AddTwoInts_Request', 'AddTwoInts_Response', 'AddTwoInts_Event'])
        impl = Fibonacci.Impl
        self.assertEqual([part.__name__ for part in (
            Fibonacci.Goal, Fibonacci.Result, Fibonacci.Feedback, impl.SendGoalService, impl.GetResultService, impl.FeedbackMessage,
            impl.CancelGoalService, impl.GoalStatusMessage)],
            ['Fibonacci_Goal', 'Fibonacci_Result', 'Fibonacci_Feedback', 'Fibonacci_SendGoal', 'Fibonacci_GetResult',
             'Fibonacci_FeedbackMessage', 'CancelGoal', 'GoalStatusArray'])
        self.assertEqual(impl.SendGoalService.Request().goal, Fibonacci.Goal())
        with self.assertRaisesRegex(NotImplementedError, 'Service classes can not be instantiated'):
            AddTwoInts()
        with self.assertRaisesRegex(NotImplementedError, 'Action classes can not be instantiated'):
            Fibonacci()


class ChecksTest(unittest.TestCase):
    def assert_refused(self, text, class_, **values):
        (field, value), = values.items()
        message = class_(check_fields=True)
        with self.assertRaises(AssertionError) as raised:
            setattr(message, field, value)
        self.assertEqual(str(raised.exception), f"The '{field}' field must be {text}")
        setattr(class_(), field, value) if class_ not in (Arrays, UnboundedSequences) else None  # nothing is checked by default

    def test_checks_one_value(self):
        self.assert_refused("of type 'str'", String, data=1)
        self.assert_refused("of type 'int'", Int8, data=1.0)
        self.assert_refused('an integer in [-128, 127]', Int8, data=128)
        self.assert_refused('an unsigned integer in [0, 65535]', BasicTypes, uint16_value=-1)
        self.assert_refused("of type 'bool'", BasicTypes, bool_value=1)
        self.assert_refused("of type 'float'", BasicTypes, float64_value=1)
        self.assert_refused('a float in [-3.402823466e+38, 3.402823466e+38]', BasicTypes, float32_value=1e39)
        self.assert_refused("of type 'bytes' or 'ByteString' with length 1", BasicTypes, byte_value=b'ab')
        self.assert_refused("a sub message of type 'Time'", Header, stamp=3)
        self.assert_refused('string value not longer than 22', Strings, bounded_string_value='x' * 23)
        BasicTypes(check_fields=True).float32_value = float('inf')

    def test_checks_many_values(self):
        self.assert_refused("a set or sequence with length 3 and each value of type 'int' and each integer in [-128, 127]", Arrays,
                            int8_values=[1, 2])
        self.assert_refused("a set or sequence with length <= 3 and each value of type 'bool'", BoundedSequences, bool_values=[True] * 4)
        self.assert_refused("a set or sequence and each value of type 'str'", UnboundedSequences, string_values='text')
        self.assert_refused("a set or sequence and each value of type 'BasicTypes'", UnboundedSequences, basic_types_values=[String()])

    def test_checks_arrays(self):
        message = Arrays(check_fields=True)
        with self.assertRaisesRegex(AssertionError, r"The 'float32_values' numpy.ndarray\(\) must have the dtype of 'numpy.float32'"):
            message.float32_values = numpy.zeros(3)
        with self.assertRaisesRegex(AssertionError, r"must have a size of 3"):
            message.float32_values = numpy.zeros(4, dtype=numpy.float32)
        kept = numpy.ones(3, dtype=numpy.float32)
        message.float32_values = kept
        self.assertIs(message.float32_values, kept)
        bounded = BoundedSequences(check_fields=True)
        with self.assertRaisesRegex(AssertionError, r"must have the type code of 'h'"):
            bounded.int16_values = array.array('i')
        with self.assertRaisesRegex(AssertionError, r'must have a size <= 3'):
            bounded.int16_values = array.array('h', [0] * 4)

    def test_the_environment_switches_checks(self):
        program = 'from std_msgs.msg import String\nString().data = 3\nString(data=3)'
        for value, options, checked in (('1', [], True), ('0', [], False), ('', [], False), ('1', ['-O'], False)):
            with self.subTest(value=value, options=options):
                done = subprocess.run([sys.executable, '-B', *options, '-c', program], capture_output=True, text=True, check=False,
                                      env={**os.environ, 'ROS_PYTHON_CHECK_FIELDS': value})
                self.assertEqual("AssertionError: The 'data' field must be of type 'str'" in done.stderr, checked, done.stderr)
                self.assertEqual(done.returncode != 0, checked)


class ConversionErrorsTest(unittest.TestCase):
    def assert_fails(self, exception, text, message):
        with self.assertRaises(exception) as raised:
            Conversion(type(message)).bytes_of(message)
        self.assertEqual(str(raised.exception), text)

    def test_names_the_field_of_a_value_that_does_not_fit(self):
        self.assert_fails(TypeError, "the field 'data' of std_msgs/msg/String must be a str, not int", String(data=3))
        self.assert_fails(TypeError, "the field 'data' of std_msgs/msg/Int8 must be an int, not float", Int8(data=1.0))
        self.assert_fails(OverflowError, "the field 'data' of std_msgs/msg/Int8 does not fit its type", Int8(data=-129))
        self.assert_fails(OverflowError, "the field 'uint64_value' of test_msgs/msg/BasicTypes does not fit its type",
                          BasicTypes(uint64_value=1 << 64))
        self.assert_fails(OverflowError, "the field 'uint8_value' of test_msgs/msg/BasicTypes does not fit its type",
                          BasicTypes(uint8_value=-1))
        self.assert_fails(TypeError, "the field 'float64_value' of test_msgs/msg/BasicTypes must be a float, not str",
                          BasicTypes(float64_value='1'))
        self.assert_fails(TypeError, "the field 'byte_value' of test_msgs/msg/BasicTypes must be bytes of length 1, not bytes",
                          BasicTypes(byte_value=b''))
        self.assert_fails(TypeError, "the field 'stamp' of std_msgs/msg/Header must be builtin_interfaces/msg/Time, not String",
                          Header(stamp=String()))
        self.assert_fails(ValueError, "the field 'bool_values' of test_msgs/msg/Arrays must have 3 elements, not 1",
                          Arrays(bool_values=[True]))
        self.assert_fails(ValueError, "the field 'string_values' of test_msgs/msg/BoundedSequences must have at most 3 elements, not 4",
                          BoundedSequences(string_values=['a'] * 4))
        self.assert_fails(ValueError, "the field 'int8_values' of test_msgs/msg/BoundedSequences must have at most 3 elements, not 4",
                          BoundedSequences(int8_values=[0] * 4))
        self.assert_fails(TypeError, "the field 'bool_values' of test_msgs/msg/Arrays must be a sequence, not int", Arrays(bool_values=3))

    def test_takes_what_is_as_good(self):
        conversion = Conversion(BasicTypes)
        message = conversion.message_of(conversion.bytes_of(BasicTypes(float64_value=2, int8_value=numpy.int64(-3), bool_value=1)))
        self.assertEqual(message, BasicTypes(float64_value=2.0, int8_value=-3, bool_value=True))
        strided = numpy.arange(6, dtype=numpy.uint8)[::2]
        message = UInt8MultiArray()
        message._data = strided
        self.assertEqual(Conversion(UInt8MultiArray).message_of(Conversion(UInt8MultiArray).bytes_of(message)).data,
                         array.array('B', [0, 2, 4]))

    def test_a_class_that_inherits_converts(self):
        class Named(String):
            """A message with a name."""

        conversion = Conversion(String)
        self.assertEqual(conversion.message_of(conversion.bytes_of(Named(data='a'))), String(data='a'))

    def test_text_that_is_not_utf_8_is_readable(self):
        conversion = Conversion(String)
        data = conversion.bytes_of(String(data='ab'))
        self.assertEqual(conversion.message_of(data.replace(b'ab', b'a\xff')).data, 'a\ufffd')


class MissingPartsTest(unittest.TestCase):
    """What a program is told where something is not installed."""

    def error_of(self, program):
        done = subprocess.run([sys.executable, '-B', '-c', program], capture_output=True, text=True, check=False)
        return done.stderr.strip().rsplit('\n', 1)[-1]

    def test_without_numpy(self):
        blocked = 'import sys; sys.modules["numpy"] = None\n'
        self.assertEqual(self.error_of(blocked + 'from std_msgs.msg import Header\nHeader(frame_id="a")'), '')
        self.assertEqual(self.error_of(blocked + 'from unique_identifier_msgs.msg import UUID\nUUID()'),
                         'ImportError: arrays of numbers in messages need numpy (Debian: python3-numpy)')

    def test_without_the_extension_module(self):
        self.assertEqual(self.error_of('import sys; sys.modules["rosidl_generator_py._type_support"] = None\n'
                                       'from std_msgs.msg import String\nString.__import_type_support__()'),
                         'ImportError: rosidl_generator_py was built without its extension module for this Python, so messages cannot '
                         'be sent (Debian: python3-dev for its build)')

    def test_imports_the_type_support_of_parts(self):
        program = ('from example_interfaces.action import Fibonacci as F\nF.__import_type_support__()\n'
                   'from action_msgs.msg import GoalInfo\n'
                   'assert all(c._TYPE_SUPPORT for c in (F, F.Goal, F.Feedback, F.Impl.SendGoalService.Request, GoalInfo,'
                   ' F.Impl.CancelGoalService.Response))')
        self.assertEqual(self.error_of(program), '')


if __name__ == '__main__':
    unittest.main()
