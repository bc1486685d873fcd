# SPDX-License-Identifier: Apache-2.0
"""
Mistakes that people make, one at a time in a launch file without any: `launch check` finds each, in its line. LAUNCH_PROGRAM is the launcher.
"""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

LAUNCH = os.environ['LAUNCH_PROGRAM']
XML = '''<launch>
  <arg name="rate" default="10" description="in hertz"/>
  <arg name="mode" default="auto"><choice value="auto"/><choice value="manual"/></arg>
  <let name="ns" value="robot"/>
  <set_env name="A" value="1"/>
  <group scoped="true">
    <push_ros_namespace namespace="$(var ns)"/>
    <node pkg="demo" exec="talker" name="talker" output="screen" respawn="true" respawn_delay="2.0">
      <param name="rate" value="$(var rate)"/>
      <param from="$(dirname)/params.yaml"/>
      <remap from="chatter" to="talk"/>
      <env name="B" value="$(env HOME)"/>
    </node>
  </group>
  <include file="$(dirname)/other.launch.xml">
    <arg name="speed" value="$(var rate)"/>
  </include>
  <executable cmd="sleep 1" name="wait" cwd="$(dirname)" if="$(eval '&quot;$(var mode)&quot; == &quot;auto&quot;')"/>
  <timer period="1.0"><log level="info" message="started"/></timer>
  <node_container pkg="demo" exec="talker" name="parts" namespace="">
    <composable_node pkg="demo" plugin="demo::Part" name="part"/>
  </node_container>
</launch>
'''
YAML = '''launch:
- arg: {name: rate, default: "10", description: in hertz}
- arg:
    name: mode
    default: auto
    choice:
    - value: auto
    - value: manual
- let: {name: ns, value: robot}
- set_env: {name: A, value: "1"}
- group:
    scoped: true
    children:
    - push_ros_namespace: {namespace: $(var ns)}
    - node:
        pkg: demo
        exec: talker
        name: talker
        output: screen
        respawn: "true"
        respawn_delay: "2.0"
        param:
        - name: rate
          value: $(var rate)
        - from: $(dirname)/params.yaml
        remap:
        - from: chatter
          to: talk
        env:
        - name: B
          value: $(env HOME)
- include:
    file: $(dirname)/other.launch.xml
    arg:
    - name: speed
      value: $(var rate)
- executable:
    cmd: sleep 1
    name: wait
    if: $(eval '"$(var mode)" == "auto"')
- timer:
    period: 1.0
    children:
    - log: {level: info, message: started}
'''
# What is replaced, by what.
OF_XML = (
    ('<arg name="rate"', '<arg nmae="rate"'), ('<arg name="rate"', '<agr name="rate"'), ('default="auto"', 'default="fast"'),
    ('<choice value="manual"/>', '<choise value="manual"/>'), ('<let name="ns" value', '<let name="ns" valu'), ('<let name="ns" value="robot"/>', '<let name="ns"/>'),
    ('<set_env name', '<set-env name'), ('<set_env name="A" value="1"/>', '<set_env name="" value="1"/>'), ('scoped="true"', 'scoped="ture"'),
    ('$(var ns)', '$(var nss)'), ('$(var ns)', '$(vra ns)'), ('$(var ns)', '$(var ns'), ('namespace="$(var ns)"', 'namespace="a b"'),
    ('pkg="demo" exec', 'pkg="dmeo" exec'), ('exec="talker"', 'exec="talkr"'), ('pkg="demo" exec', 'package="demo" exec'), ('exec="talker" name', 'name'),
    ('name="talker"', 'name="1talker"'), ('output="screen"', 'output="scren"'), ('respawn="true"', 'respawn="maybe"'), ('respawn_delay="2.0"', 'respawn_delay="soon"'),
    ('<param name="rate" value="$(var rate)"/>', '<param name="rate"/>'), ('<param name="rate" value', '<parm name="rate" value'),
    ('$(dirname)/params.yaml', '$(dirname)/parms.yaml'), ('$(dirname)/params.yaml', '$(dirname)/broken.yaml'), ('to="talk"', 'too="talk"'), ('to="talk"', 'to=""'),
    ('$(env HOME)', '$(env HOMEE_)'), ('$(env HOME)', '$(env)'), ('other.launch.xml', 'othr.launch.xml'), ('other.launch.xml', 'other.lauch.xml'),
    ('<arg name="speed"', '<arg name="sped"'), ('cmd="sleep 1"', 'cmd="slep_ 1"'), ('cmd="sleep 1"', 'cmd="sleep \'1"'), ('== &quot;auto', '=== &quot;auto'),
    ('cwd="$(dirname)"', 'cwd="/no/such/place"'), ('period="1.0"', 'period="one"'), ('level="info"', 'level="inof"'), ('demo::Part', 'demo::Prat'),
    ('<composable_node pkg="demo"', '<composable_node pkg="other"'), ('  </group>', '  </grup>'), ('<timer period="1.0">', '<timer>'))
OF_YAML = (
    ('arg: {name: rate', 'arg: {nmae: rate'), ('- arg: {name: rate', '- agr: {name: rate'), ('- arg:\n    name: mode\n    default: auto', '- arg:\n    name: mode\n    default: fast'), ('- value: manual', '- valu: manual'),
    ('value: robot}', 'valu: robot}'), ('{name: ns, value: robot}', '{name: ns}'), ('- set_env:', '- set-env:'), ('scoped: true', 'scoped: ture'),
    ('children:\n    - push', 'actions:\n    - push'), ('$(var ns)', '$(var nss)'), ('$(var ns)', '$(vra ns)'), ('$(var ns)', '$(var ns'),
    ('namespace: $(var ns)', 'namespace: a b'), ('pkg: demo', 'pkg: dmeo'), ('exec: talker', 'exec: talkr'), ('pkg: demo', 'package: demo'),
    ('name: talker', 'name: 1talker'), ('output: screen', 'output: scren'), ('respawn: "true"', 'respawn: maybe'), ('respawn_delay: "2.0"', 'respawn_delay: soon'),
    ('param:\n        - name: rate', 'parm:\n        - name: rate'), ('params.yaml', 'parms.yaml'), ('params.yaml', 'broken.yaml'), ('to: talk\n', 'too: talk\n'), ('$(env HOME)', '$(env HOMEE_)'),
    ('other.launch.xml', 'othr.launch.xml'), ('- name: speed', '- name: sped'), ('- executable:\n    cmd: sleep 1', '- executable:\n    cmd: slep_ 1'), ('== "auto"', '=== "auto"'), ('period: 1.0', 'period: one'),
    ('level: info', 'level: inof'), ('- timer:', '- tmer:'), ('- include:', '- includ:'), ('file: $(dirname)', 'fil: $(dirname)'), ('- timer:\n    period: 1.0\n', '- timer:\n'),
    ('- let: {name: ns', '- let: {name ns'), ('value: robot}', 'value: [robot}'))


class Mutations(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.directory = pathlib.Path(directory.name).resolve()
        prefix = self.directory / 'prefix'
        index = prefix / 'share/ament_index/resource_index'
        (index / 'packages').mkdir(parents=True)
        (index / 'rclcpp_components').mkdir()
        (prefix / 'lib/demo').mkdir(parents=True)
        (prefix / 'share/demo').mkdir()
        (index / 'packages/demo').touch()
        (index / 'rclcpp_components/demo').write_text('demo::Part;lib/libpart.so\n')
        (prefix / 'lib/libpart.so').touch()
        (prefix / 'lib/demo/talker').write_text('#!/bin/sh\n')
        (prefix / 'lib/demo/talker').chmod(0o755)
        self.files = self.directory / 'files'
        self.files.mkdir()
        for name, text in (('params.yaml', '/**:\n  ros__parameters:\n    a: 1\n'), ('broken.yaml', '/**:\n  ros__paramters:\n    a: 1\n'),
                           ('other.launch.xml', '<launch>\n  <arg name="speed" default="1"/>\n  <executable cmd="sleep $(var speed)"/>\n</launch>\n')):
            (self.files / name).write_text(text)
        self.environment = {**os.environ, 'AMENT_PREFIX_PATH': str(prefix), 'ROS_LOG_DIR': str(self.directory / 'log')}

    def check(self, *files):
        """The lines with findings of each file; those of what it includes count where it does."""
        result = subprocess.run([LAUNCH, 'check', '--format', 'json', *files], cwd=self.files, capture_output=True, text=True, check=False, env=self.environment)
        found = {}
        for one in json.loads(result.stdout):
            file, line = one['included_from'][-1].rsplit(':', 2)[:2] if one['included_from'] else (one['file'], one['line'])
            found.setdefault(pathlib.Path(file).name, []).append((int(line), one['id'], one['message']))
        return found

    def try_all(self, text, mutations, ending):
        (self.files / f'right{ending}').write_text(text)
        self.assertEqual(self.check(f'right{ending}'), {})
        files, lines = [], []
        for number, (before, after) in enumerate(mutations):
            self.assertIn(before, text)
            files.append(f'm{number}{ending}')
            # A value of YAML that only a visit finds wrong is told at its action, an unknown item at its first line.
            lines.append(text[:text.index(before)].count('\n') + 1 + (before.startswith('param:\n')))
            (self.files / files[-1]).write_text(text.replace(before, after, 1))
        missed = []
        for file, line, mutation in zip(files, lines, mutations):
            found = self.check(file).get(file, [])
            if line not in [one[0] for one in found]:
                missed.append((mutation, line, found))
        self.assertEqual(missed, [])

    def test_xml(self):
        self.try_all(XML, OF_XML, '.launch.xml')

    def test_yaml(self):
        self.try_all(YAML, OF_YAML, '.launch.yaml')

    def test_there_are_79(self):
        self.assertEqual(len(OF_XML) + len(OF_YAML), 79)


if __name__ == '__main__':
    unittest.main()
