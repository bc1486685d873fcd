# SPDX-License-Identifier: Apache-2.0
"""
The launcher's packages against the names of ROS 2's launch and launch_ros (ros2_names.tsv), and the page about them.

`python3 python_names_test.py --page` prints docs/python_names.md. LAUNCH_PACKAGES is the folder of the packages.
"""

import importlib
import inspect
import os
import pathlib
import re
import sys
import types
import unittest

HERE = pathlib.Path(__file__).parent
PAGE = HERE.parents[2] / 'docs/python_names.md'
HEAD = """# Names of launch and launch_ros

What of ROS 2's Python packages launch files and Python programs can import here. This page is generated from the list of ROS 2's names in
`tests/unit/python/ros2_names.tsv`; `python_names_test` compares it with the packages.

| module | name | arguments | what can be asked |
| --- | --- | --- | --- |
"""


def rows():
    for line in (HERE / 'ros2_names.tsv').read_text().splitlines()[1:]:
        module, name, arguments, members, absent = line.split('\t')
        yield module, name, arguments.split(), members.split(), absent


def page():
    text = HEAD
    for module, name, arguments, members, absent in rows():
        given = ', '.join(f'`{argument}`' for argument in arguments)
        asked = absent and f'not available: {absent}' or ', '.join(f'`{member}`' for member in members)
        text += f'| `{module}` | `{name}` | {given} | {asked} |\n'
    return text


TRIPLETS = HERE.parents[1] / 'golden/triplets'
# What has no like in XML and YAML: functions of the launch file, the stacks of scopes, what ROS 2 has no event for, and
# the values that handlers get. ForEachVar and ForLoopIndex belong to loops of XML; Python's call a function.
PYTHON_ONLY = {
    'ExecutionComplete', 'ForEachVar', 'ForLoopIndex', 'LocalSubstitution', 'OnExecutionComplete',
    'OnIncludeLaunchDescription', 'OnProcessIO', 'OpaqueCoroutine', 'OpaqueFunction', 'PopEnvironment', 'PopLaunchConfigurations',
    'ProcessExited', 'ProcessIO', 'ProcessStarted', 'ProcessStderr', 'ProcessStdin', 'ProcessStdout',
    'ProcessTargetedEvent', 'PushEnvironment', 'PushLaunchConfigurations', 'RunningProcessEvent', 'StateTransition',
    'SubstitutionFailure', 'TimerEvent'}
OF_TRIPLETS = ('actions', 'conditions', 'descriptions', 'event_handlers', 'events', 'events.process',
               'events.lifecycle', 'launch_description_sources', 'substitutions')


class PythonNames(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        engine = types.ModuleType('_launch_engine')
        engine.is_running = lambda: False
        engine.IS_PROGRAM = True  # LaunchService is that of Python programs
        sys.modules['_launch_engine'] = engine
        for name in ('rclpy', 'rclpy.executors'):  # what a workspace has built; the modules that use it are only imported
            sys.modules[name] = types.ModuleType(name)
        sys.modules['rclpy.executors'].SingleThreadedExecutor = object
        sys.path.insert(0, os.environ['LAUNCH_PACKAGES'])

    def has(self, thing, member):
        """A class has a member, or its objects get it when they are made."""
        return hasattr(thing, member) or any(
            f'self.{member} = ' in inspect.getsource(base) for base in thing.__mro__ if base.__module__ != 'builtins')

    def takes(self, thing, argument):
        """A function or a class has the argument, or hands all that it has not on."""
        parameters = inspect.signature(thing.__init__ if inspect.isclass(thing) else thing).parameters
        return argument in parameters or any(each.kind is each.VAR_KEYWORD for each in parameters.values())

    def test_every_name_of_ros2_is_there_or_told_to_be_absent(self):
        for module, name, arguments, members, absent in rows():
            with self.subTest(module=module, name=name):
                try:
                    thing = getattr(importlib.import_module(module), name, None)
                except ModuleNotFoundError:
                    thing = None  # told to be absent, or the next line tells it
                self.assertEqual(thing is None, bool(absent))
                if thing is not None:
                    self.assertEqual([member for member in members if not self.has(thing, member)], [])
                    self.assertEqual([each for each in arguments if not self.takes(thing, each)], [])

    def test_every_class_that_xml_and_yaml_can_express_is_in_a_triplet(self):
        text = '\n'.join(path.read_text() for path in TRIPLETS.glob('*.launch.py'))
        used = set(re.findall(r'\w+', text))
        wanted = {name for module, name, _, _, absent in rows() if module.partition('.')[2] in OF_TRIPLETS
                  and name[0].isupper() and not absent and not name.endswith('Error')}
        self.assertEqual(sorted(wanted - used - PYTHON_ONLY), [])

    def test_the_page_is_generated(self):
        self.assertEqual(PAGE.read_text(), page())


if __name__ == '__main__':
    if sys.argv[1:] == ['--page']:
        print(page(), end='')
    else:
        unittest.main()
