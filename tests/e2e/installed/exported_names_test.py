# SPDX-License-Identifier: Apache-2.0
"""
What the C++ libraries for others let others see: the names of their own namespaces. A name of the project's inner libraries, or of
a library of headers such as fmt, would stand for the same name of another version in the same process.
"""

import os
import subprocess
import unittest
from pathlib import Path

LIBRARIES = Path(os.environ['BUILD_DIRECTORY']) / 'prefix/lib'


class ExportedNames(unittest.TestCase):

    def exported(self, name):
        listed = subprocess.run(['nm', '-D', '-C', '--defined-only', '--format=posix', LIBRARIES / f'lib{name}.so'], capture_output=True, text=True, check=True)
        # A demangled name has spaces in it: the kind, the value and the size stand behind it.
        return sorted({line.rsplit(' ', 3)[0] for line in listed.stdout.splitlines()})

    def test_only_names_of_the_interface(self):
        for name, namespace, some, templates in (
                ('launch_trace_reader', 'launch_trace', ('launch_trace::Reader::Reader(', 'bool launch_trace::read<launch_trace::ros2::CallbackStart>('),
                 ('bool launch_trace::read<',)),
                ('launch_trace_testing', 'launch_trace_testing', ('launch_trace_testing::Trace::Trace(',), ())):
            with self.subTest(name):
                names = self.exported(name)
                for wanted in some:
                    self.assertTrue([found for found in names if found.startswith(wanted)], wanted)
                ours = templates + tuple(kind + namespace + '::' for kind in ('', 'typeinfo for ', 'typeinfo name for ', 'vtable for '))
                self.assertEqual([found for found in names if not found.startswith(ours)], [])


if __name__ == '__main__':
    unittest.main()
