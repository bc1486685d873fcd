# SPDX-License-Identifier: Apache-2.0
"""The files that the parser of .msg, .srv and .action files accepts, and its errors for mistakes."""

import unittest

from rosidl_generator.cpp_types import literal, string_literal
from rosidl_generator.interface_definition import Type, snake_case
from rosidl_generator.interface_parser import InterfaceError, parse_file

KNOWN = {'pkg/msg/Point', 'pkg/msg/Pose', 'std_msgs/msg/Header', 'builtin_interfaces/msg/Time',
         'service_msgs/msg/ServiceEventInfo'}


def message(text, name='Test'):
    return parse_file(f'msg/{name}.msg', text, 'pkg', 'msg', KNOWN).messages[0]


def only_field(text):
    return message(text).fields[0]


class AcceptedText(unittest.TestCase):
    def test_types(self):
        self.assertEqual(only_field('float64 x').type, Type('float64'))
        self.assertEqual(only_field('string<=5 x').type, Type('string', string_bound=5))
        self.assertEqual(only_field('int8[] x').type, Type('int8', is_sequence=True))
        self.assertEqual(only_field('int8[4] x').type, Type('int8', array_size=4))
        self.assertEqual(only_field('int8[<=4] x').type, Type('int8', is_sequence=True, sequence_bound=4))
        self.assertEqual(only_field('wstring<=2[<=3] x').type,
                         Type('wstring', string_bound=2, is_sequence=True, sequence_bound=3))

    def test_messages_of_this_and_other_packages(self):
        self.assertEqual(only_field('Point p').type, Type('Point', 'pkg'))
        self.assertEqual(only_field('pkg/Point p').type, Type('Point', 'pkg'))
        self.assertEqual(only_field('std_msgs/Header h').type, Type('Header', 'std_msgs'))
        self.assertEqual(only_field('std_msgs/msg/Header[] h').type, Type('Header', 'std_msgs', is_sequence=True))

    def test_comments_and_blank_lines(self):
        parsed = message('# first\n\n  int32 a  # after\nint32 b 3# tight\n\t\n')
        self.assertEqual([(f.name, f.default) for f in parsed.fields], [('a', None), ('b', 3)])

    def test_number_sign_in_quotes_is_no_comment(self):
        self.assertEqual(only_field('string s "a # b" # c').default, 'a # b')

    def test_defaults(self):
        self.assertEqual(only_field('uint8 x 0xff').default, 255)
        self.assertEqual(only_field('float32 x -1e3').default, -1000.0)
        self.assertEqual(only_field('bool x False').default, False)
        self.assertEqual(only_field("string x 'a\"b'").default, 'a"b')
        self.assertEqual(only_field(r'string x "a\"b\n"').default, 'a"b\n')
        self.assertEqual(only_field('string x bare words').default, 'bare words')
        self.assertEqual(only_field('int8[] x []').default, [])
        self.assertEqual(only_field('string[] x ["a, b", c]').default, ['a, b', 'c'])

    def test_constants(self):
        parsed = message("uint8 A=1\nstring B = it's\nfloat32 C=-.5\nstring D=")
        self.assertEqual([(c.name, c.value) for c in parsed.constants],
                         [('A', 1), ('B', "it's"), ('C', -0.5), ('D', '')])
        self.assertEqual(parsed.fields, [])
        self.assertEqual(parsed.members[0].name, 'structure_needs_at_least_one_member')

    def test_default_with_an_equals_sign(self):
        self.assertEqual(only_field('string s "a=b"').default, 'a=b')

    def test_service(self):
        file = parse_file('srv/Add.srv', 'int64 a\n---\nint64 sum\n', 'pkg', 'srv', KNOWN)
        self.assertEqual([m.name for m in file.messages], ['Add_Request', 'Add_Response', 'Add_Event'])
        self.assertEqual(file.services[0].response.fields[0].name, 'sum')
        self.assertEqual([(f.name, f.type) for f in file.services[0].event.fields], [
            ('info', Type('ServiceEventInfo', 'service_msgs')),
            ('request', Type('Add_Request', 'pkg', is_sequence=True, sequence_bound=1, namespace='srv')),
            ('response', Type('Add_Response', 'pkg', is_sequence=True, sequence_bound=1, namespace='srv'))])

    def test_action(self):
        file = parse_file('action/Count.action', 'int32 to\n---\nPoint end\n---\nint32 at\n', 'pkg', 'action',
                          KNOWN | {'unique_identifier_msgs/msg/UUID'})
        fields = {m.name: [(f'{f.type.package}/{f.type.namespace}/{f.type.name}' if f.type.is_message else f.type.name,
                            f.name) for f in m.fields] for m in file.messages}
        goal_id = ('unique_identifier_msgs/msg/UUID', 'goal_id')
        info = ('service_msgs/msg/ServiceEventInfo', 'info')
        self.assertEqual(fields, {
            'Count_Goal': [('int32', 'to')],
            'Count_Result': [('pkg/msg/Point', 'end')],
            'Count_Feedback': [('int32', 'at')],
            'Count_SendGoal_Request': [goal_id, ('pkg/action/Count_Goal', 'goal')],
            'Count_SendGoal_Response': [('bool', 'accepted'), ('builtin_interfaces/msg/Time', 'stamp')],
            'Count_SendGoal_Event': [info, ('pkg/action/Count_SendGoal_Request', 'request'),
                                     ('pkg/action/Count_SendGoal_Response', 'response')],
            'Count_GetResult_Request': [goal_id],
            'Count_GetResult_Response': [('int8', 'status'), ('pkg/action/Count_Result', 'result')],
            'Count_GetResult_Event': [info, ('pkg/action/Count_GetResult_Request', 'request'),
                                      ('pkg/action/Count_GetResult_Response', 'response')],
            'Count_FeedbackMessage': [goal_id, ('pkg/action/Count_Feedback', 'feedback')]})
        self.assertEqual([s.cpp for s in file.services],
                         ['pkg::action::Count_SendGoal', 'pkg::action::Count_GetResult'])
        self.assertEqual(file.action.cpp, 'pkg::action::Count')
        self.assertEqual([t.name for t in file.messages_of_others], ['Point', 'UUID', 'Time', 'ServiceEventInfo'])

    def test_file_names_are_those_of_ros(self):
        for name, expected in (('String', 'string'), ('ColorRGBA', 'color_rgba'), ('PointCloud2', 'point_cloud2'),
                               ('UInt8MultiArray', 'u_int8_multi_array'), ('Point32', 'point32'), ('UUID', 'uuid'),
                               ('Pose2D', 'pose2_d'), ('Float64MultiArray', 'float64_multi_array')):
            self.assertEqual(snake_case(name), expected)


class Mistakes(unittest.TestCase):
    maxDiff = None

    def check(self, text, expected, path='msg/Test.msg', namespace='msg', known=None):
        with self.assertRaises(InterfaceError) as caught:
            parse_file(path, text, 'pkg', namespace, KNOWN if known is None else known)
        self.assertEqual(str(caught.exception), expected)

    def test_unknown_type_is_shown_with_its_line_and_a_suggestion(self):
        self.check('int32 a\n  Pont p', "msg/Test.msg:2:3: error: unknown type 'Pont', did you mean 'Point'?\n"
                                        '    Pont p\n    ^')
        self.check('Header h', "msg/Test.msg:1:1: error: unknown type 'Header', did you mean 'std_msgs/Header'?\n"
                               '  Header h\n  ^')
        self.check('time t', "msg/Test.msg:1:1: error: unknown type 'time', did you mean "
                             "'builtin_interfaces/Time'?\n  time t\n  ^")
        self.check('strin s', "msg/Test.msg:1:1: error: unknown type 'strin', did you mean 'string'?\n  strin s\n  ^")
        self.check('std_msgs/Heder h', "msg/Test.msg:1:1: error: unknown type 'std_msgs/Heder', did you mean "
                                       "'std_msgs/Header'?\n  std_msgs/Heder h\n  ^")

    def test_package_that_is_no_dependency(self):
        self.check('geometry_msgs/Pose p', "msg/Test.msg:1:1: error: package 'geometry_msgs' is not among the "
                                           'DEPENDENCIES of rosidl_generate_interfaces\n  geometry_msgs/Pose p\n  ^')

    def test_names(self):
        self.check('int32 Bad', "msg/Test.msg:1:7: error: 'Bad' is not a field name: it must be lower case letters, "
                                'digits and single underscores, starting with a letter\n  int32 Bad\n        ^')
        self.check('int32 lower=1', "msg/Test.msg:1:7: error: 'lower' is not a constant name: it must be capitals, "
                                    'digits and single underscores, starting with a letter\n  int32 lower=1\n        ^')
        self.check('int32', 'msg/Test.msg:1:6: error: the name is missing: a line is `type name` or `type NAME=value`\n'
                            '  int32\n       ^')
        self.check('int32 a\nint8 a', "msg/Test.msg:2:6: error: there is already a member 'a'\n  int8 a\n       ^")

    def test_type_name(self):
        self.check('int32 a', "msg/lower.msg:1:1: error: 'lower' is not a type name: it must be letters and digits, "
                              'starting with a capital\n  int32 a\n  ^', path='msg/lower.msg')

    def test_values(self):
        self.check('uint8 x 256', 'msg/Test.msg:1:9: error: 256 does not fit uint8, which goes from 0 to 255\n'
                                  '  uint8 x 256\n          ^')
        self.check('int32 x 1.5', "msg/Test.msg:1:9: error: '1.5' is not an integer\n  int32 x 1.5\n          ^")
        self.check('bool x maybe', "msg/Test.msg:1:8: error: 'maybe' is not a bool: write true or false\n"
                                   '  bool x maybe\n         ^')
        self.check('int32 X=', 'msg/Test.msg:1:9: error: the value is missing\n  int32 X=\n          ^')
        self.check('string x "open', 'msg/Test.msg:1:10: error: the string is not closed by "\n  string x "open\n'
                                     '           ^')
        self.check('string<=2 x "abc"', 'msg/Test.msg:1:13: error: 3 characters for a string of at most 2\n'
                                        '  string<=2 x "abc"\n              ^')
        self.check('Point p 3', 'msg/Test.msg:1:9: error: a message cannot have a default\n  Point p 3\n          ^')

    def test_arrays(self):
        self.check('int8[2] x [1, 2, 3]', 'msg/Test.msg:1:11: error: 3 values for an array of 2\n'
                                          '  int8[2] x [1, 2, 3]\n            ^')
        self.check('int8[<=1] x [1, 2]', 'msg/Test.msg:1:13: error: 2 values for a sequence of at most 1\n'
                                         '  int8[<=1] x [1, 2]\n              ^')
        self.check('int8[] x [1, 300]', 'msg/Test.msg:1:14: error: 300 does not fit int8, which goes from -128 to 127\n'
                                        '  int8[] x [1, 300]\n               ^')
        self.check('int8[] x 1', 'msg/Test.msg:1:10: error: the default of an array is a list: [1, 2, 3]\n'
                                 '  int8[] x 1\n           ^')
        self.check('int8[0] x', 'msg/Test.msg:1:6: error: the size must be a number above 0\n  int8[0] x\n       ^')
        self.check('int8[x] x', "msg/Test.msg:1:5: error: '[x]' is not an array: write [], [N] or [<=N]\n"
                                '  int8[x] x\n      ^')
        self.check('int8<=3 x', "msg/Test.msg:1:5: error: only strings have a bound here; for many write 'int8[<=3]'\n"
                                '  int8<=3 x\n      ^')
        self.check('int8[] X=3', 'msg/Test.msg:1:8: error: a constant must be a single primitive\n'
                                 '  int8[] X=3\n         ^')

    def test_service_parts(self):
        self.check('int32 a', "srv/Add.srv:1:1: error: no '---' between the request and the response\n  int32 a\n  ^",
                   path='srv/Add.srv', namespace='srv')
        self.check('---\n---', "srv/Add.srv:2:1: error: only a .srv file has '---', and only one\n  ---\n  ^",
                   path='srv/Add.srv', namespace='srv')
        self.check('int8 a\n---', "srv/Add.srv:1:1: error: a service uses service_msgs/msg/ServiceEventInfo: name "
                   "'service_msgs' among the DEPENDENCIES of rosidl_generate_interfaces\n  int8 a\n  ^",
                   'srv/Add.srv', 'srv', known={'std_msgs/msg/Header'})
        self.check('---\nint8 a',
                   "action/Do.action:2:1: error: no '---' between the result and the feedback\n  int8 a\n  ^",
                   'action/Do.action', 'action')
        self.check('---\n---\n---', "action/Do.action:3:1: error: an .action file has two '---'\n  ---\n  ^",
                   'action/Do.action', 'action')
        self.check('int8 a\n---\n---',
                   'action/Do.action:1:1: error: an action uses unique_identifier_msgs/msg/UUID: name '
                   "'unique_identifier_msgs' among the DEPENDENCIES of rosidl_generate_interfaces\n  int8 a\n  ^",
                   'action/Do.action', 'action')
        self.check('int8 a\n---', "msg/Test.msg:2:1: error: a .msg file has no '---'\n  ---\n  ^")


class Literals(unittest.TestCase):
    def test_strings_are_plain_ascii(self):
        self.assertEqual(string_literal('a"b\\c\n??='), r'"a\042b\134c\012\077\077="')
        self.assertEqual(string_literal('ä1'), r'"\303\2441"')
        self.assertEqual(string_literal('ä1', wide=True), r'u"\xe4" u"1"')
        self.assertEqual(string_literal('', wide=True), 'u""')

    def test_extreme_integers(self):
        self.assertEqual(literal(Type('int64'), -(1 << 63)), '(-9223372036854775807LL - 1)')
        self.assertEqual(literal(Type('uint64'), (1 << 64) - 1), '18446744073709551615ULL')

    def test_floats(self):
        self.assertEqual(literal(Type('float32'), 0.5), '0.5f')
        self.assertEqual(literal(Type('float64'), float('inf')), 'std::numeric_limits<double>::infinity()')


if __name__ == '__main__':
    unittest.main()
