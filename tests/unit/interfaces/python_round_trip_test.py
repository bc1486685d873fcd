# SPDX-License-Identifier: Apache-2.0
"""Messages of all types of the stack go from Python to bytes and back, and C++ reads and writes the same bytes."""

import unittest

from ros_messages import Conversion, CppType, Values, classes_of, packages

CLASSES = [class_ for package in packages() for class_ in classes_of(package)]
SEEDS = range(3)


class RoundTripTest(unittest.TestCase):
    def check(self, compare):
        self.assertGreater(len(CLASSES), 300)
        for class_ in CLASSES:
            with self.subTest(type=f'{class_.__module__}.{class_.__name__}'):
                compare(class_)

    def test_every_message_comes_back_as_it_was(self):
        def compare(class_):
            conversion = Conversion(class_)
            for seed in SEEDS:
                message = Values(seed).message(class_)
                self.assertEqual(conversion.message_of(conversion.bytes_of(message)), message)

        self.check(compare)

    def test_cpp_reads_and_writes_the_same_bytes(self):
        def compare(class_):
            conversion, cpp = Conversion(class_), CppType(class_)
            for seed in SEEDS:
                data = conversion.bytes_of(Values(seed).message(class_))
                self.assertEqual(cpp.bytes_after_reading(data), data)

        self.check(compare)

    def test_new_messages_have_the_values_of_new_messages_in_cpp(self):
        def compare(class_):
            self.assertEqual(Conversion(class_).bytes_of(class_()), CppType(class_).bytes_of_new_message())

        self.check(compare)


if __name__ == '__main__':
    unittest.main()
