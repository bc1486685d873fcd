# SPDX-License-Identifier: Apache-2.0
"""Front ends that packages write in Python: entities of their own, from which the launcher's parser makes actions."""

import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

LAUNCH = os.environ['LAUNCH_PROGRAM']

# A front end whose entities are calls with keywords.
FRONTEND = '''
from typing import List

from launch.frontend.entity import Entity as BaseEntity
from launch.frontend.expose import action_parse_methods
from launch.frontend.parser import Parser
from launch.frontend.type_utils import check_is_list_entity
from launch.utilities.type_utils import AllowedTypesType, AllowedValueType, is_instance_of


class Entity(BaseEntity):
    def __init__(self, type_name, **attributes):
        self._name, self._given, self._read = type_name, attributes, set()

    @property
    def type_name(self):
        return self._name

    @property
    def children(self):
        self._read.add('children')
        return self._given['children']

    def get_attr(self, name, *, data_type=str, optional=False, can_be_str=True):
        name = name + '_' if name in ('if', 'exec') else name
        if name not in self._given:
            if optional:
                return None
            raise AttributeError(f'{self._name} has no {name}')
        self._read.add(name)
        value = self._given[name]
        if check_is_list_entity(data_type):
            return [item if isinstance(item, BaseEntity) else Entity(name, **item) for item in value]
        if not is_instance_of(value, data_type, can_be_str=can_be_str):
            raise TypeError(f'{name} of {self._name} must be of type {data_type}, got {type(value)}')
        return value

    def assert_entity_completely_parsed(self):
        left = self._given.keys() - self._read
        if left:
            raise ValueError(f'Unexpected key(s) found in `{self._name}`: {sorted(left)}')


def __getattr__(name):
    Parser.load_launch_extensions()
    if name not in action_parse_methods:
        raise AttributeError(name)
    return lambda **attributes: Entity(name, **attributes)


def launch(actions):
    return Parser().parse_description(Entity('launch', children=actions))
'''

FILE = '''
from frontend import (Entity, arg, executable, group, include, launch, let, load_composable_node, log_info, node,
                      node_container, push_ros_namespace, set_env, set_parameter, set_remap, timer)


def generate_launch_description():
    return launch([
        arg(name='message', default='hello world', choice=[{'value': 'hello world'}]),
        executable(cmd='echo $(var message)', output='both', env=[{'name': 'A', 'value': 'b'}]),
        executable(cmd='echo left out', if_='$(not true)'),
        set_parameter(name='use_sim_time', value='true'),
        set_remap(**{'from': 'a', 'to': 'b'}),
        group(children=[
            push_ros_namespace(namespace='left'), let(name='a', value='1'),
            set_env(name='B', value='$(var a)'),
            node(exec_='/bin/true', name='talker', args='-x $(var a)', respawn='true', respawn_delay=2.0,
                 param=[{'name': 'rate', 'value': 5}, {'name': 'g', 'param': [{'name': 'h', 'value': [1, 2]}]}],
                 remap=[{'from': 'chatter', 'to': '/out'}])]),
        node_container(exec_='/bin/true', name='box', namespace='', composable_node=[
            {'pkg': 'demo', 'plugin': 'demo::Talker', 'name': 'part', 'param': [{'name': 'a', 'value': 1}]}]),
        load_composable_node(target='box', composable_node=[{'pkg': 'demo', 'plugin': 'demo::Other', 'name': 'more'}]),
        include(file='$(dirname)/inner.launch.xml', arg=[arg(name='x', value='given')]),
        timer(period=2.0, children=[log_info(message='later')]),
        log_info(message='$(var message)'),
    ])
'''

INNER = '<launch><arg name="x"/><log_info message="x=$(var x)"/></launch>\n'

XML = '''<launch>
  <arg name="message" default="hello world"><choice value="hello world"/></arg>
  <executable cmd="echo $(var message)" output="both"><env name="A" value="b"/></executable>
  <executable cmd="echo left out" if="$(not true)"/>
  <set_parameter name="use_sim_time" value="true"/>
  <set_remap from="a" to="b"/>
  <group>
    <push_ros_namespace namespace="left"/>
    <let name="a" value="1"/>
    <set_env name="B" value="$(var a)"/>
    <node exec="/bin/true" name="talker" args="-x $(var a)" respawn="true" respawn_delay="2.0">
      <param name="rate" value="5"/>
      <param name="g"><param name="h" value="[1, 2]"/></param>
      <remap from="chatter" to="/out"/>
    </node>
  </group>
  <node_container exec="/bin/true" name="box" namespace="">
    <composable_node pkg="demo" plugin="demo::Talker" name="part"><param name="a" value="1"/></composable_node>
  </node_container>
  <load_composable_node target="box"><composable_node pkg="demo" plugin="demo::Other" name="more"/></load_composable_node>
  <include file="$(dirname)/inner.launch.xml"><arg name="x" value="given"/></include>
  <timer period="2.0"><log_info message="later"/></timer>
  <log_info message="$(var message)"/>
</launch>
'''


class Frontends(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.write('frontend.py', FRONTEND)
        self.write('inner.launch.xml', INNER)

    def write(self, name, text):
        (self.folder / name).write_text(text)
        return self.folder / name

    def launch(self, *words):
        return subprocess.run([LAUNCH, *map(str, words)], capture_output=True, text=True,
                              env={**os.environ, 'PYTHONPATH': str(self.folder)})

    def plan(self, path):
        done = self.launch('--dry-run=json', path)
        self.assertEqual(done.returncode, 0, done.stderr)

        def without_places(value):
            if isinstance(value, dict):
                return {key: without_places(inner) for key, inner in value.items()
                        if key not in ('source', 'include_count', 'includes', 'python_includes')}
            return [without_places(inner) for inner in value] if isinstance(value, list) else value
        return without_places(json.loads(done.stdout))

    def test_entities_of_a_package_become_actions(self):
        self.assertEqual(self.plan(self.write('a.launch.py', FILE)), self.plan(self.write('a.launch.xml', XML)))

    def test_a_key_that_no_action_reads_is_an_error(self):
        done = self.launch('--dry-run', self.write('a.launch.py', '''
from frontend import launch, log_info


def generate_launch_description():
    return launch([log_info(message='a', colour='red')])
'''))
        self.assertEqual(done.returncode, 1)
        self.assertIn("Unexpected key(s) found in `log_info`: ['colour']", done.stderr)

    def test_the_parser_takes_a_stream(self):
        done = self.launch(self.write('a.launch.py', '''
import io
from launch.frontend import Parser


def generate_launch_description():
    root, parser = Parser.load(io.StringIO('<launch><let name="a" value="1"/><log_info message="a=$(var a)"/></launch>'))
    other, yaml_parser = Parser.load(io.StringIO('launch:\\\\n- log_info: {message: from yaml}'))
    description = parser.parse_description(root)
    for action in yaml_parser.parse_description(other).entities:
        description.add_action(action)
    return description
'''.replace('\\\\n', '\\n')))
        self.assertEqual([line for line in done.stdout.splitlines() if 'launch.user' in line],
                         ['[INFO] [launch.user]: a=1', '[INFO] [launch.user]: from yaml'])


if __name__ == '__main__':
    unittest.main()
