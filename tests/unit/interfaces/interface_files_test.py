# SPDX-License-Identifier: Apache-2.0
"""The generator reads the files of tests/golden/interfaces as their `.expected` say.

tests/unit/messages/interface_files_test.cpp expects the same of the launcher's own parser, so both read alike. A line
that begins with `generator:` or `launcher:` is for one of the two. With LAUNCH_UPDATE_GOLDEN=1 expected texts that are
missing are written; read them before committing.
"""

import json
import os
import unittest
from pathlib import Path

from rosidl_generator.idl_parser import parse_idl
from rosidl_generator.interface_parser import PARTS, InterfaceError, parse_file

FOLDER = Path(__file__).resolve().parents[2] / 'golden/interfaces'
NAMESPACES = {'IdlAdd': 'srv'}
KNOWN = {'std_msgs/msg/Header', 'test/msg/Point', 'builtin_interfaces/msg/Time', 'service_msgs/msg/ServiceEventInfo',
         'unique_identifier_msgs/msg/UUID'}


def type_text(type_):
    text = f'{type_.package}/{type_.name}' if type_.is_message else type_.name.replace('idl_char', 'char')
    text += f'<={type_.string_bound}' if type_.string_bound else ''
    bound = f'<={type_.sequence_bound}' if type_.sequence_bound else ''
    return text + (f'[{type_.array_size}]' if type_.is_array else f'[{bound}]' if type_.is_sequence else '')


def value_text(value):
    if isinstance(value, list):
        return f'[{", ".join(value_text(item) for item in value)}]'
    if isinstance(value, float):
        return repr(value).removesuffix('.0')
    return json.dumps(value)


def is_zero(value):
    return not (any(value) if isinstance(value, list) else value)


def content(path):
    namespace = NAMESPACES.get(path.stem, 'msg' if path.suffix == '.idl' else path.suffix[1:])
    parse = parse_idl if path.suffix == '.idl' else parse_file
    with open(path, encoding='utf-8', newline='') as file:
        text = file.read()
    try:
        messages = parse(path.name, text, 'test', namespace, KNOWN).messages
    except InterfaceError as error:
        return [str(error).split('\n', 1)[0]]
    lines = []
    for message in messages[:max(1, len(PARTS[namespace]))]:
        lines.append(message.name)
        lines += [f'  constant {type_text(c.type)} {c.name} = {value_text(c.value)}' for c in message.constants]
        for field in message.fields:
            default = '' if is_zero(field.default) else f' = {value_text(field.default)}'
            lines.append(f'  field {type_text(field.type)} {field.name}{default}')
    return lines


class InterfaceFiles(unittest.TestCase):
    def test_generator_reads_what_is_expected(self):
        paths = sorted(path for path in FOLDER.rglob('*') if path.suffix[1:] in (*PARTS, 'idl'))
        self.assertGreater(len(paths), 30)
        for path in paths:
            with self.subTest(path.name):
                file = path.with_name(path.name + '.expected')
                if 'LAUNCH_UPDATE_GOLDEN' in os.environ and not file.exists():
                    file.write_text('\n'.join(content(path)) + '\n')
                expected = file.read_text().splitlines()
                own = [line.removeprefix('generator: ') for line in expected if line.startswith('generator: ')]
                self.assertEqual(content(path), own or [line for line in expected if not line.startswith('launcher: ')])


if __name__ == '__main__':
    unittest.main()
