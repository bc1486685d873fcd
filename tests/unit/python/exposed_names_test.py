# SPDX-License-Identifier: Apache-2.0
"""Packages that add actions and substitutions to XML and YAML files, with expose_action() and expose_substitution()."""

import json
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

LAUNCH = os.environ['LAUNCH_PROGRAM']

PACKAGE = '''
from typing import List

from launch import Action, Substitution
from launch.actions import ExecuteProcess, GroupAction, OpaqueFunction
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


@expose_action('later')
class Later(OpaqueFunction):
    """A class of the launcher that no element of ROS 2 stands for."""

    @classmethod
    def parse(cls, entity, parser):
        _, kwargs = super().parse(entity, parser)
        name = parser.parse_substitution(entity.get_attr('name'))
        kwargs['function'] = lambda context: [ExecuteProcess(cmd=['later', name])]
        return cls, kwargs


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
  <later name="$(var robot)" if="true"/>
  <later name="not" if="false"/>
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
- later: {name: $(var robot), if: "true"}
- later: {name: "not", if: "false"}
- verbose: {cmd: "echo 'a b' --$(var robot)", level: "$(upper 'x$(var robot)')", env: [{name: A, value: "1"}]}
- group:
  - twice:
    - let: {name: robot, value: c3}
    - node: {exec: /bin/true, name: $(var robot), param: [{name: n, value: 10}]}
'''


# Derived classes that change nothing, each under the name of the launcher's own action with `own_` in front.
DERIVED = """
from launch.actions import (
    AppendEnvironmentVariable, DeclareLaunchArgument, ExecuteProcess, ForEach, ForLoop, GroupAction, IncludeLaunchDescription,
    Log, LogError, LogInfo, ReplaceEnvironmentVariables, ResetEnvironment, ResetLaunchConfigurations, SetEnvironmentVariable,
    SetLaunchConfiguration, Shutdown, TimerAction, UnsetEnvironmentVariable, UnsetLaunchConfiguration)
from launch.frontend import expose_action
from launch_ros.actions import (
    ComposableNodeContainer, LifecycleNode, LoadComposableNodes, Node, PushROSNamespace, RosTimer, SetParameter,
    SetParametersFromFile, SetRemap, SetROSLogDir, SetUseSimTime)
from tracetools_launch.action import Trace

for name, base in {
        'append_env': AppendEnvironmentVariable, 'arg': DeclareLaunchArgument, 'executable': ExecuteProcess,
        'for': ForLoop, 'for_each': ForEach, 'group': GroupAction, 'include': IncludeLaunchDescription, 'lifecycle_node': LifecycleNode,
        'load_composable_node': LoadComposableNodes, 'log': Log, 'log_error': LogError, 'log_info': LogInfo, 'node': Node,
        'node_container': ComposableNodeContainer, 'push_ros_namespace': PushROSNamespace, 'rep_env':
        ReplaceEnvironmentVariables, 'reset': ResetLaunchConfigurations, 'reset_env': ResetEnvironment, 'ros_timer': RosTimer,
        'set_env': SetEnvironmentVariable, 'let': SetLaunchConfiguration, 'set_parameter': SetParameter,
        'set_parameters_from_file': SetParametersFromFile, 'set_remap': SetRemap, 'set_ros_log_dir': SetROSLogDir,
        'set_use_sim_time': SetUseSimTime, 'shutdown': Shutdown, 'timer': TimerAction, 'trace': Trace,
        'unset': UnsetLaunchConfiguration, 'unset_env': UnsetEnvironmentVariable}.items():
    expose_action(f'own_{name}')(type(base.__name__, (base,), {}))
"""

# ACTION is 'own_' or nothing.
OF_ALL = """<launch>
  <ACTIONarg name="robot" default="r1" description="which"><choice value="r1"/><choice value="r2"/></ACTIONarg>
  <ACTIONset_env name="A" value="$(var robot)"/>
  <ACTIONappend_env name="A" value="more" prepend="true" separator=","/>
  <ACTIONlet name="speed" value="7"/>
  <ACTIONlet name="turns" value="2"/>
  <ACTIONlog level="warning" message="a $(var speed)"/>
  <ACTIONlog_info message="b $(var speed)"/>
  <ACTIONlog_error message="c"/>
  <ACTIONtrace session-name="own" append-timestamp="true" events-ust="ros2:a 'ros2:b'" context-fields="vpid vtid"
      subbuffer-size-ust="8192"/>
  <ACTIONexecutable cmd="echo 'a b' $(var robot)" cwd="/" output="screen" respawn="true" respawn_delay="2.5" shell="false"/>
  <ACTIONset_parameter name="p" value="5"/>
  <ACTIONset_parameter name="q" value="$(var speed)"/>
  <ACTIONset_parameters_from_file filename="$(dirname)/p.yaml"/>
  <ACTIONset_use_sim_time value="true"/>
  <ACTIONset_remap from="x" to="y"/>
  <ACTIONset_ros_log_dir new_log_dir="/tmp"/>
  <ACTIONgroup scoped="true" forwarding="false"><keep name="robot" value="$(var robot)"/>
    <ACTIONpush_ros_namespace namespace="space"/>
    <ACTIONnode exec="/bin/true" name="n" namespace="m" args="--a 'b c'" ros_args="--log-level info">
      <param name="i" value="1"/><param name="s" value="'1'"/><param name="l" value="[1, 2]"/><param from="$(dirname)/p.yaml"/>
      <remap from="a" to="b"/><env name="B" value="2"/>
    </ACTIONnode>
    <ACTIONlifecycle_node exec="/bin/true" name="l" namespace="" autostart="false"/>
    <ACTIONnode_container exec="/bin/true" name="c" namespace="">
      <composable_node pkg="p" plugin="P" name="part" namespace="inner">
        <param name="z" value="3"/><remap from="k" to="l"/><extra_arg name="use_intra_process_comms" value="true"/>
      </composable_node>
    </ACTIONnode_container>
    <ACTIONload_composable_node target="c"><composable_node pkg="p" plugin="Q" name="q" if="true"/></ACTIONload_composable_node>
  </ACTIONgroup>
  <ACTIONnode exec="/bin/true" name="all"/>
  <ACTIONunset name="speed"/>
  <ACTIONunset_env name="A"/>
  <ACTIONtimer period="1.5"><ACTIONexecutable cmd="echo timer"/></ACTIONtimer>
  <ACTIONros_timer period="2"><ACTIONexecutable cmd="echo ros"/></ACTIONros_timer>
  <ACTIONfor len="$(var turns)" name="i">
    <ACTIONexecutable cmd="echo turn $(index i)"/>
    <ACTIONfor_each values="{name: 'a b', id: $(index i)};{name: c, parts: [1, x]};{}">
      <executable cmd="echo $(index i) $(for-var name none) $(for-var id 7) $(for-var parts '')"/>
    </ACTIONfor_each>
  </ACTIONfor>
  <ACTIONfor len="0" name="none"><ACTIONexecutable cmd="echo never"/></ACTIONfor>
  <ACTIONfor_each values="" if="true"><ACTIONexecutable cmd="echo never"/></ACTIONfor_each>
  <ACTIONinclude file="$(dirname)/inner.launch.xml"><arg name="given" value="$(var robot)"/></ACTIONinclude>
  <ACTIONreset><keep name="robot" value="kept"/></ACTIONreset>
  <ACTIONexecutable cmd="echo $(var robot)" if="$(eval 'True')"/>
  <ACTIONrep_env><env name="ONLY" value="this"/></ACTIONrep_env>
  <ACTIONexecutable cmd="/bin/true" name="after"/>
  <ACTIONreset_env/>
  <ACTIONshutdown reason="enough" unless="true"/>
</launch>
"""


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
                                 [['bridge', 'r2', '7', 'scan', 'R2'], ['later', 'r2'], ['echo', 'a b', '--r2', 'XR2'], node, node])
                self.assertEqual(commands[2][1], {'A': '1'})
                self.assertEqual(list(commands[3][2][0].values()), list(parameters[0].values()))

    def test_classes_derived_from_the_launchers_take_the_arguments_of_its_own_actions(self):
        self.add_package(self.directory / 'derived', 'derived_actions', DERIVED)
        (self.directory / 'p.yaml').write_text('/**:\n  ros__parameters: {from_file: 1}\n')
        (self.directory / 'inner.launch.xml').write_text('<launch><executable cmd="echo $(var given)"/></launch>')
        self.maxDiff = None
        plans = []
        for prefix in ('', 'own_'):
            result = self.launch('all.launch.xml', OF_ALL.replace('ACTION', prefix), '--dry-run=json', python='derived')
            self.assertEqual(result.returncode, 0, result.stderr)
            # The two sessions are named at two times.
            plans.append(json.loads(re.sub(r'own-\d{14}', 'own-TIME', result.stdout)))
        self.assertIn('own-TIME', str(plans[0]))
        self.assertEqual(len(plans[0]['processes']), 18)
        for plan in plans:
            plan.pop('includes', None)
            for found in plan['processes']:
                found.pop('source', None)
        self.assertEqual(plans[1], plans[0])

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
