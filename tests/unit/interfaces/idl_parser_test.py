# SPDX-License-Identifier: Apache-2.0
"""The .idl files that the parser accepts, and its errors for mistakes."""

import unittest

from rosidl_generator.idl_parser import parse_idl
from rosidl_generator.interface_definition import Field, Type
from rosidl_generator.interface_parser import InterfaceError, parse_file

KNOWN = {'pkg/msg/Point', 'builtin_interfaces/msg/Time', 'service_msgs/msg/ServiceEventInfo',
         'unique_identifier_msgs/msg/UUID'}


def parse(body, name='Test', namespace='msg'):
    return parse_idl(f'{namespace}/{name}.idl', f'module pkg {{ module {namespace} {{\n{body}\n}}; }};', 'pkg', namespace, KNOWN)


def fields(members):
    return parse(f'struct Test {{\n{members}\n}};').messages[0].fields


class AcceptedText(unittest.TestCase):
    def test_types(self):
        self.assertEqual([field.type for field in fields('''
            boolean a; octet b; char c; short d; unsigned short e; long f; unsigned long g; long long h;
            unsigned long long i; float j; double k; int8 l; uint64 m; string n; wstring<4> o; sequence<long> p;
            sequence<string<3>, 2> q; uint8 r[16]; pkg::msg::Point s; Point t; sequence<builtin_interfaces::msg::Time> u;''')], [
                Type('bool'), Type('byte'), Type('idl_char'), Type('int16'), Type('uint16'), Type('int32'), Type('uint32'),
                Type('int64'), Type('uint64'), Type('float32'), Type('float64'), Type('int8'), Type('uint64'), Type('string'),
                Type('wstring', string_bound=4), Type('int32', is_sequence=True),
                Type('string', string_bound=3, is_sequence=True, sequence_bound=2), Type('uint8', array_size=16),
                Type('Point', 'pkg'), Type('Point', 'pkg'), Type('Time', 'builtin_interfaces', is_sequence=True)])

    def test_comments_includes_and_annotations_have_no_effect(self):
        self.assertEqual(fields('''#include "pkg/msg/Point.idl"
            // a line
            /* and
               more */
            @verbatim (language="comment", text="a (bracket) \\"quoted\\"" "and on")
            @unit (value="m") @key long a;'''), [Field(Type('int32'), 'a')])

    def test_defaults(self):
        self.assertEqual([field.default for field in fields('''
            @default (value=-3) long a; @default (value=TRUE) boolean b; @default (value="x\\"y") string c;
            @default (value=1e3) double d; @default (value="(1, 2)") sequence<octet> e;
            @default (value=0x1F) uint8 f;''')], [-3, True, 'x"y', 1000.0, [1, 2], 31])

    def test_constants_give_sizes_and_belong_to_their_message(self):
        message = parse('''module Test_Constants {
              const uint64 CAPACITY = 8; const string NAME = "n"; const long MASK = (1 << 3) | 2; const float HALF = 1.0 / 2;
            };
            struct Test { long data[CAPACITY - 1]; long more[Test_Constants::CAPACITY]; };''').messages[0]
        self.assertEqual([(c.type.name, c.name, c.value) for c in message.constants],
                         [('uint64', 'CAPACITY', 8), ('string', 'NAME', 'n'), ('int32', 'MASK', 10), ('float32', 'HALF', 0.5)])
        self.assertEqual(message.fields, [Field(Type('int32', array_size=7), 'data'),
                                          Field(Type('int32', array_size=8), 'more')])

    def test_typedefs(self):
        self.assertEqual(parse('typedef double double__36[36];\nstruct Test { double__36 covariance; };').messages[0].fields,
                         [Field(Type('float64', array_size=36), 'covariance')])

    def test_services_and_actions_are_those_of_their_short_forms(self):
        service = parse('struct Add_Request { int64 a; };\nstruct Add_Response { int64 sum; };', 'Add', 'srv')
        self.assertEqual(service, parse_file('srv/Add.srv', 'int64 a\n---\nint64 sum', 'pkg', 'srv', KNOWN))
        action = parse('struct Go_Goal { long a; };\nstruct Go_Result { long b; };\nstruct Go_Feedback { long c; };', 'Go',
                       'action')
        self.assertEqual(action, parse_file('action/Go.action', 'int32 a\n---\nint32 b\n---\nint32 c', 'pkg', 'action', KNOWN))

    def test_a_message_without_members(self):
        self.assertEqual(fields('uint8 structure_needs_at_least_one_member;'), [])


class Errors(unittest.TestCase):
    def expect(self, text, error):
        with self.assertRaises(InterfaceError) as raised:
            parse_idl('msg/Test.idl', text, 'pkg', 'msg', KNOWN)
        self.assertEqual(str(raised.exception), error)

    def test_they_point_at_the_place(self):
        self.expect('module pkg {\n  module msg {\n    struct Test {\n      Pint p;\n',
                    "msg/Test.idl:4:7: error: unknown type 'pkg::msg::Pint'\n        Pint p;\n        ^")
        self.expect('module pkg { module msg { struct Test { long a } }; };',
                    "msg/Test.idl:1:48: error: expected ';' and not '}'\n"
                    '  module pkg { module msg { struct Test { long a } }; };\n' + ' ' * 49 + '^')
        self.expect('module pkg { module msg { struct Test { @default (value=300) octet a; }; }; };',
                    'msg/Test.idl:1:57: error: 300 does not fit byte, which goes from 0 to 255\n'
                    '  module pkg { module msg { struct Test { @default (value=300) octet a; }; }; };\n' + ' ' * 58 + '^')
        self.expect('module pkg { };', "msg/Test.idl:1:1: error: the file must define 'struct Test' in module 'pkg::msg'\n"
                                       '  module pkg { };\n  ^')


if __name__ == '__main__':
    unittest.main()
