# SPDX-License-Identifier: Apache-2.0
"""Compares the hashes of definitions with those that ROS 2 systems announce."""

import glob
import os
import unittest

from rosidl_generator.interface_parser import parse_file
from rosidl_generator.type_hash import describe, describe_file, referenced, type_hash

INTERFACES = os.path.join(os.path.dirname(__file__), '../../../instrumented_stack/interfaces')


def shipped_descriptions():
    paths = [path for extension in ('msg', 'srv', 'action') for path in glob.glob(f'{INTERFACES}/*/*/*.{extension}')]
    parts = {path: os.path.relpath(path, INTERFACES).split('/') for path in paths}
    known = {f'{package}/msg/{name[:-4]}' for package, namespace, name in parts.values() if namespace == 'msg'}
    descriptions = {}
    for path, (package, namespace, _) in parts.items():
        with open(path, encoding='utf-8') as file:
            for description in describe_file(parse_file(path, file.read(), package, namespace, known)):
                descriptions[description['type_name']] = description
    return descriptions


class TypeHash(unittest.TestCase):
    def setUp(self):
        self.descriptions = shipped_descriptions()

    def hash_of(self, name):
        return type_hash(self.descriptions[name], self.descriptions)

    def test_known_hashes(self):
        # The hashes that ROS 2 Jazzy announces.
        for name, expected in (
                ('std_msgs/msg/Empty', '20b625256f32d5dbc0d04fee44f43c41e51c70d3502f84b4a08e7a9c26a96312'),
                ('example_interfaces/action/Fibonacci_FeedbackMessage',
                 'c1de71afd52e49a89c53d8262366884185bc0a02f78ce051c4e46b0a7fe59bb2'),
                ('example_interfaces/srv/AddTwoInts',
                 'e118de6bf5eeb66a2491b5bda11202e7b68f198d6f67922cf30364858239c81a'),
                ('example_interfaces/action/Fibonacci',
                 '9508051da1ea4658de144b09bd0690ff3de52104683d847aed764d2915906f51'),
                ('std_msgs/msg/String', 'df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18'),
                ('geometry_msgs/msg/Twist', '9c45bf16fe0983d80e3cfe750d6835843d265a9a6c46bd2e609fcddde6fb8d2a'),
                ('geometry_msgs/msg/TwistStamped', '5f0fcd4f81d5d06ad9b4c4c63e3ea51b82d6ae4d0558f1d475229b1121db6f64')):
            self.assertEqual(self.hash_of(name), f'RIHS01_{expected}')

    def test_description(self):
        message = parse_file('msg/A.msg', 'string<=5[<=3] s ["x"]\nbyte[] b\nPoint[2] p\n', 'pkg', 'msg',
                             {'pkg/msg/Point'}).messages[0]
        self.assertEqual(describe(message), {'type_name': 'pkg/msg/A', 'fields': [
            {'name': 's', 'type': {'type_id': 117, 'capacity': 3, 'string_capacity': 5, 'nested_type_name': ''}},
            {'name': 'b', 'type': {'type_id': 160, 'capacity': 0, 'string_capacity': 0, 'nested_type_name': ''}},
            {'name': 'p', 'type': {'type_id': 49, 'capacity': 2, 'string_capacity': 0,
                                   'nested_type_name': 'pkg/msg/Point'}}]})

    def test_referenced_messages_are_found_once_at_any_depth(self):
        self.assertEqual(sorted(referenced([self.descriptions['geometry_msgs/msg/TwistStamped']], self.descriptions)),
                         ['builtin_interfaces/msg/Time', 'geometry_msgs/msg/Twist', 'geometry_msgs/msg/Vector3',
                          'std_msgs/msg/Header'])

    def test_every_shipped_type_has_a_hash_of_its_own(self):
        hashes = {self.hash_of(name) for name in self.descriptions}
        self.assertEqual(len(hashes), len(self.descriptions))


if __name__ == '__main__':
    unittest.main()
