# SPDX-License-Identifier: Apache-2.0
"""Packages that add actions and substitutions to XML and YAML files, with expose_action() and expose_substitution()."""

import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

LAUNCH = os.environ['LAUNCH_PROGRAM']

PACKAGE = '''
from typing import List

from launch import Action, Substitution
from launch.actions import ExecuteProcess, GroupAction
from launch.frontend import Entity, expose_action, expose_substitution


@expose_action('bridge')
class Bridge(Action):
    """An action that makes others when it is executed."""

    def __init__(self, *, name, topics, rate=None, **kwargs):
        super().__init__(**kwargs)
        self._name, self._topics, self._rate = name, topics, rate

    @classmethod
    def parse(cls, entity, parser):
        _, kwargs = super().parse(entity, parser)
        kwargs['name'] = parser.parse_substitution(entity.get_attr('name'))
        kwargs['rate'] = entity.get_attr('rate', data_type=int, optional=True, can_be_str=False)
        kwargs['topics'] = [parser.parse_substitution(topic.get_attr('name'))
                            for topic in entity.get_attr('topic', data_type=List[Entity], optional=True) or []]
        return cls, kwargs

    def execute(self, context):
        return [ExecuteProcess(cmd=['bridge', self._name, str(self._rate), *self._topics])]


@expose_action('verbose')
class Verbose(ExecuteProcess):
    """One of the launcher's classes with an argument more."""

    @classmethod
    def parse(cls, entity, parser):
        _, kwargs = super().parse(entity, parser)
        level = entity.get_attr('level', optional=True)
        if level is not None:
            kwargs['cmd'] = [*kwargs['cmd'], parser.parse_substitution(level)]
        return cls, kwargs


@expose_action('twice')
def twice(entity, parser):
    """A function, whose children are actions of the launcher's."""
    children = [parser.parse_action(child) for child in entity.children]
    return GroupAction, {'actions': [*children, *children]}


@expose_substitution('upper')
class Upper(Substitution):

    def __init__(self, parts):
        super().__init__()
        self._parts = parts

    @classmethod
    def parse(cls, data):
        if len(data) != 1:
            raise TypeError('upper takes 1 argument')
        return cls, {'parts': data[0]}

    def perform(self, context):
        return ''.join(context.perform_substitution(part) for part in self._parts).upper()
'''

XML = '''<launch>
  <arg name="robot" default="r2"/>
  <bridge name="$(var robot)" rate="7" if="true"><topic name="scan"/><topic name="$(upper $(var robot))"/></bridge>
  <bridge name="not" unless="true"/>
  <verbose cmd="echo 'a b' --$(var robot)" level="$(upper 'x$(var robot)')"><env name="A" value="1"/></verbose>
  <group>
    <twice><let name="robot" value="c3"/><node exec="/bin/true" name="$(var robot)"><param name="n" value="10"/></node></twice>
  </group>
</launch>
'''

YAML = '''launch:
- arg: {name: robot, default: r2}
- bridge: {name: $(var robot), rate: 7, if: "true", topic: [{name: scan}, {name: $(upper $(var robot))}]}
- bridge: {name: "not", unless: "true"}
- verbose: {cmd: "echo 'a b' --$(var robot)", level: "$(upper 'x$(var robot)')", env: [{name: A, value: "1"}]}
- group:
  - twice:
    - let: {name: robot, value: c3}
    - node: {exec: /bin/true, name: $(var robot), param: [{name: n, value: 10}]}
'''


class ExposedNames(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls._temporary = tempfile.TemporaryDirectory()
        cls.directory = Path(cls._temporary.name)
        cls.add_package(cls.directory / 'python', 'robot_actions', PACKAGE)

    @classmethod
    def tearDownClass(cls):
        cls._temporary.cleanup()

    @staticmethod
    def add_package(path, name, text):
        (path / name).mkdir(parents=True)
        (path / name / '__init__.py').write_text(text)
        info = path / f'{name}-1.0.dist-info'
        info.mkdir()
        (info / 'METADATA').write_text(f'Metadata-Version: 2.1\nName: {name}\nVersion: 1.0\n')
        (info / 'entry_points.txt').write_text(f'[launch.frontend.launch_extension]\n{name} = {name}\n')

    def launch(self, name, text, *words, python='python'):
        self.path = self.directory / name
        self.path.write_text(text)
        environment = {**os.environ, 'PYTHONPATH': str(self.directory / python)}
        return subprocess.run([LAUNCH, *words, self.path], capture_output=True, text=True, env=environment)

    def commands(self, name, text):
        result = self.launch(name, text, '--dry-run=json')
        self.assertEqual((result.returncode, result.stderr), (0, ''))
        return [(process['argv'], process['env'], process.get('params')) for process in
                json.loads(result.stdout)['processes']]

    def test_their_actions_and_substitutions_work_in_xml_and_in_yaml(self):
        node = ['/bin/true', '--ros-args', '-r', '__node:=c3', '--params-file', '@params:0']
        parameters = [{'/**/c3': {'ros__parameters': {'n': 10}}}]
        for name, text in (('a.launch.xml', XML), ('a.launch.yaml', YAML)):
            with self.subTest(name):
                commands = self.commands(name, text)
                self.assertEqual([argv for argv, _, _ in commands],
                                 [['bridge', 'r2', '7', 'scan', 'R2'], ['echo', 'a b', '--r2', 'XR2'], node, node])
                self.assertEqual(commands[1][1], {'A': '1'})
                self.assertEqual(list(commands[2][2][0].values()), list(parameters[0].values()))

    def assert_error(self, line, expected, python='python'):
        result = self.launch('wrong.launch.xml', f'<launch>\n  {line}\n</launch>\n', '--dry-run', python=python)
        self.assertEqual((result.returncode, result.stdout), (1, ''))
        self.assertEqual(result.stderr, expected.replace('FILE', str(self.path)).replace('LINE', line))

    def test_errors_are_told_at_the_element(self):
        self.assert_error('<bridge nam="x"/>', """\
FILE:2:4: error: attribute 'name' not found in entity 'bridge'
    2 |   LINE
      |    ^~~~~~
""")
        self.assert_error('<bridge name="x" rat="3"/>', """\
FILE:2:20: error: unexpected attribute 'rat' in 'bridge'
    2 |   LINE
      |                    ^~~
      = help: did you mean 'rate'?
""")
        self.assert_error('<bridge name="x" rate="often"/>', """\
FILE:2:26: error: attribute 'rate' of 'bridge': invalid literal for int() with base 10: 'often'
    2 |   LINE
      |                          ^~~~~
""")
        self.assert_error('<bridge name="$(var nothing)"/>', """\
FILE:2:17: error: launch configuration 'nothing' does not exist
    2 |   LINE
      |                 ^~~~~~~~~~~~~~
      = help: declare it with 'arg', set it with 'let', or give a default: $(var nothing DEFAULT)
""")
        self.assert_error('<brigde name="x"/>', """\
FILE:2:4: error: unrecognized entity of the type 'brigde'
    2 |   LINE
      |    ^~~~~~
      = help: did you mean 'bridge'?
""")
        self.assert_error('<log message="$(uper x)"/>', """\
FILE:2:19: error: unknown substitution 'uper'
    2 |   LINE
      |                   ^~~~
      = help: did you mean 'upper'?
""")

    def test_an_exception_of_the_package_names_its_line(self):
        line = 1 + PACKAGE.splitlines().index("            raise TypeError('upper takes 1 argument')")
        self.assert_error('<log message="$(upper a b)"/>', f"""\
FILE:2:17: error: 'upper' can't be made: TypeError: upper takes 1 argument
    2 |   LINE
      |                 ^~~~~~~~~~~~
      = help: raised at {self.directory}/python/robot_actions/__init__.py:{line}
""")

    def test_a_package_that_can_not_be_imported_is_named_where_a_name_is_unknown(self):
        self.add_package(self.directory / 'broken', 'broken_actions', 'import no_such_module\n')
        self.assert_error('<bridge name="x"/>', """\
FILE:2:4: error: unrecognized entity of the type 'bridge'
    2 |   LINE
      |    ^~~~~~
      = help: the extension 'broken_actions' can't be loaded: ModuleNotFoundError: No module named 'no_such_module'
""", python='broken')


if __name__ == '__main__':
    unittest.main()
