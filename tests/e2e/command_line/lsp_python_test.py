# SPDX-License-Identifier: Apache-2.0
"""
The language server on Python launch files, which it does not run, and its quick fixes. LAUNCH_PROGRAM is the launcher.
"""

import os
import pathlib
import subprocess
import tempfile
import unittest

from lsp_test import BASE, Editor, column

PYTHON = '''import os
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.launch_description_sources import AnyLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

HERE = os.path.dirname(__file__)


def generate_launch_description():
    speed = LaunchConfiguration('speed')
    return LaunchDescription([
        DeclareLaunchArgument('speed', default_value='7', description='how fast', choices=['7', '8']),
        IncludeLaunchDescription(
            AnyLaunchDescriptionSource(os.path.join(HERE, 'base.launch.xml')),
            launch_arguments={'speed': speed, 'mode': 'manual'}.items()),
        Node(package='demo', executable='talker', name='t', parameters=[{'speed': LaunchConfiguration('speed')}]),
    ])
'''
XML = '''<launch>
  <include file="$(dirname)/top.launch.py">
    <arg name="speed" value="8"/>
  </include>
</launch>
'''


class InADirectory(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.directory = pathlib.Path(directory.name).resolve()
        prefix = self.directory / '.prefix'
        (prefix / 'share/ament_index/resource_index/packages').mkdir(parents=True)
        (prefix / 'share/ament_index/resource_index/packages/demo').touch()
        (prefix / 'share/demo').mkdir()
        (prefix / 'share/demo/package.xml').write_text('<package/>')
        (prefix / 'lib/demo').mkdir(parents=True)
        (prefix / 'lib/demo/talker').write_text('#!/bin/sh\n')
        (prefix / 'lib/demo/talker').chmod(0o755)
        before = os.environ.get('AMENT_PREFIX_PATH')
        os.environ['AMENT_PREFIX_PATH'] = str(prefix)
        self.addCleanup(lambda: os.environ.pop('AMENT_PREFIX_PATH') if before is None else os.environ.update(AMENT_PREFIX_PATH=before))
        for name, text in (('base.launch.xml', BASE), ('top.launch.py', PYTHON), ('over.launch.xml', XML)):
            (self.directory / name).write_text(text)

    def editor(self, *words, **options):
        editor = Editor(self.directory, *words, **options)
        self.addCleanup(editor.process.wait)
        self.addCleanup(editor.process.stdout.close)
        self.addCleanup(editor.process.stdin.close)
        return editor


class PythonInTheServer(InADirectory):
    def at_mark(self, editor, text, method='labels', name='a.launch.py'):
        """Asks at the place of the bar, which is taken out."""
        before, after = text.split('|')
        editor.open(name, before + after)
        line, character = before.count('\n'), len(before) - before.rfind('\n') - 1
        return editor.labels(name, line, character) if method == 'labels' else editor.at(method, name, line, character)

    def test_modules_and_names_of_imports(self):
        editor = self.editor()
        self.assertIn('launch_ros.actions', self.at_mark(editor, 'from launch_ros.|\n'))
        labels = self.at_mark(editor, 'from launch_ros.actions import No|\n')
        self.assertIn('Node', labels)
        self.assertNotIn('DeclareLaunchArgument', labels)
        self.assertIn('Node', self.at_mark(editor, 'from launch_ros.actions import (\n    LifecycleNode,\n    No|\n)\n'))
        self.assertIn('TimerAction', self.at_mark(editor, 'from launch import actions\nactions.|\n'))

    def test_arguments_of_a_class(self):
        editor = self.editor()
        labels = self.at_mark(editor, PYTHON.replace("name='t',", '|'))
        self.assertIn('namespace=', labels)
        self.assertIn('respawn_delay=', labels)
        self.assertNotIn('package=', labels)  # it is there
        self.assertNotIn('namespace=', self.at_mark(editor, PYTHON.replace("name='t'", 'name=|')))

    def test_a_name_that_is_not_imported_brings_its_import(self):
        editor = self.editor()
        items = self.at_mark(editor, PYTHON.replace("    speed = L", "    x = Timer|\n    speed = L"), 'completion')['items']
        [item] = [item for item in items if item['label'] == 'TimerAction']
        self.assertEqual(item['additionalTextEdits'][0]['newText'], 'from launch.actions import TimerAction\n')
        self.assertEqual(item['additionalTextEdits'][0]['range']['start'], {'line': 7, 'character': 0})

    def test_a_star_imports_all_names_of_a_module(self):
        editor = self.editor()
        text = 'from launch.actions import *\nx = Timer|\n'
        [item] = [item for item in self.at_mark(editor, text, 'completion')['items'] if item['label'] == 'TimerAction']
        self.assertNotIn('additionalTextEdits', item)
        self.assertNotIn('*', self.at_mark(editor, text))
        editor.diagnostics('a.launch.py')
        editor.open('b.launch.py', 'from launch.actions import *\nx = TimerAction(perod=1.0)\n')
        self.assertEqual([one['message'] for one in editor.diagnostics('b.launch.py')], ["TimerAction has no argument 'perod'\ndid you mean 'period'?"])

    def test_values_in_quotes(self):
        editor = self.editor()
        self.assertIn('demo', self.at_mark(editor, PYTHON.replace("package='demo'", "package='|'")))
        self.assertEqual(self.at_mark(editor, PYTHON.replace("executable='talker'", "executable='|'")), ['talker'])
        self.assertEqual(self.at_mark(editor, PYTHON.replace("parameters=[{'speed': LaunchConfiguration('speed')}]",
                                                             "parameters=[{'speed': LaunchConfiguration('|')}]")), ['speed'])
        self.assertIn('demo', self.at_mark(editor, PYTHON.replace('HERE = ', "SHARE = get_package_share_directory('|')\nHERE = ")))
        self.assertEqual(self.at_mark(editor, PYTHON.replace("'mode': 'manual'", "'|': 'manual'")), ['speed', 'mode'])
        self.assertEqual(self.at_mark(editor, PYTHON.replace("'manual'", "'|'")), ['auto', 'manual'])
        self.assertIn('base.launch.xml', self.at_mark(editor, PYTHON.replace("'base.launch.xml'", "'|'")))

    def test_it_works_while_a_call_is_being_written(self):
        editor = self.editor()
        begun = PYTHON[:PYTHON.index("name='t'")]
        self.assertIn('namespace=', self.at_mark(editor, begun + '|'))
        self.assertIn('namespace=', self.at_mark(editor, begun + 'name|\n\ndef other():\n    pass\n'))

    def test_help(self):
        editor = self.editor()
        told = self.at_mark(editor, PYTHON.replace('Node(package', 'No|de(package'), 'hover')['contents']['value']
        self.assertIn('Node(executable=…, package=…', told)
        told = self.at_mark(editor, PYTHON.replace("speed = LaunchConfiguration('speed')", "speed = LaunchConfiguration('sp|eed')"), 'hover')
        self.assertEqual(told['contents']['value'], 'argument **speed**: how fast\n\ndefault: `7`')
        told = self.at_mark(editor, PYTHON.replace("package='demo'", "package='de|mo'"), 'hover')['contents']['value']
        self.assertIn('.prefix/share/demo', told)

    def test_definitions(self):
        editor = self.editor()
        line = PYTHON.split('\n').index("        DeclareLaunchArgument('speed', default_value='7', description='how fast', choices=['7', '8']),")
        found = self.at_mark(editor, PYTHON.replace("speed = LaunchConfiguration('speed')", "speed = LaunchConfiguration('sp|eed')"), 'definition')
        self.assertEqual(found['range']['start'], {'line': line, 'character': column(PYTHON, line, "'speed'", 1)})
        for before, after, target in (("package='demo'", "package='de|mo'", '.prefix/share/demo/package.xml'),
                                      ("executable='talker'", "executable='tal|ker'", '.prefix/lib/demo/talker'),
                                      ("'base.launch.xml'", "'base|.launch.xml'", 'base.launch.xml')):
            with self.subTest(after=after):
                found = self.at_mark(editor, PYTHON.replace(before, after), 'definition')
                self.assertEqual(found['uri'], editor.uri(target))
        found = self.at_mark(editor, PYTHON.replace("'mode': 'manual'", "'mo|de': 'manual'"), 'definition')
        self.assertEqual((found['uri'], found['range']['start']), (editor.uri('base.launch.xml'), {'line': 2, 'character': 13}))

    def test_an_argument_is_renamed_across_the_formats(self):
        editor = self.editor()
        editor.open('top.launch.py', PYTHON)
        line = next(number for number, text in enumerate(PYTHON.split('\n')) if 'DeclareLaunchArgument(\'' in text)
        edits = editor.at('rename', 'top.launch.py', line, column(PYTHON, line, "'speed'", 2), newName='pace')['changes']
        self.assertEqual(sorted((pathlib.Path(uri).name, len(places)) for uri, places in edits.items()),
                         [('over.launch.xml', 1), ('top.launch.py', 3)])
        found = editor.at('references', 'top.launch.py', line, column(PYTHON, line, "'speed'", 2), context={'includeDeclaration': True})
        self.assertEqual(len(found), 4)

    def test_arguments_of_an_included_python_file(self):
        editor = self.editor()
        text = '<launch><include file="$(dirname)/top.launch.py"><arg name=""/></include></launch>'
        editor.open('b.launch.xml', text)
        items = editor.at('completion', 'b.launch.xml', 0, column(text, 0, '""', 1))['items']
        self.assertEqual([(item['label'], item['detail']) for item in items], [('speed', 'default: 7')])

    def test_what_an_included_python_file_sets_is_there(self):
        include = '<launch>\n<arg name="top" default="1"/>\n<include file="$(dirname)/c.launch.py"/>\n<log level="info" message="{}"/>\n</launch>\n'
        python = ('from launch import LaunchDescription\nfrom launch.actions import *\nfrom launch.substitutions import LaunchConfiguration\n\n\n'
                  'def generate_launch_description():\n    return LaunchDescription([\n        LogInfo(msg=LaunchConfiguration("top")),\n        {}])\n')
        for action, read, missing in (
                ("DeclareLaunchArgument('speed', default_value='7')", '$(var speed)', []),
                ("DeclareLaunchArgument('speed', default_value='7')", '$(var sped)', ["launch configuration 'sped' does not exist"]),
                ("DeclareLaunchArgument('speed', default_value=str(7)), SetLaunchConfiguration('made', ['a'])", '$(var speed) $(var made)', []),
                ("OpaqueFunction(function=set_speed)", '$(var speed)', []),
                ("SetEnvironmentVariable('SPEED', '1')", '$(env SPEED)', []),
                ("SetLaunchConfiguration('a' + 'b', '1')", '$(var ab)', []),
                ("LogInfo(msg='')", '$(var speed)', ["launch configuration 'speed' does not exist"])):
            with self.subTest(action=action, read=read):
                (self.directory / 'c.launch.py').write_text(python.replace('{}', action))
                editor = self.editor()
                editor.open('d.launch.xml', include.replace('{}', read))
                self.assertEqual([one['message'].split('\n')[0] for one in editor.diagnostics('d.launch.xml')], missing)
                self.assertEqual(editor.end(), 0)

    def test_outline(self):
        editor = self.editor()
        editor.open('top.launch.py', PYTHON)
        symbols = editor.ask('textDocument/documentSymbol', {'textDocument': {'uri': editor.uri('top.launch.py')}})
        [top] = [one for one in symbols if one['name'] == 'LaunchDescription']
        self.assertEqual([one['name'] for one in top['children']], ['DeclareLaunchArgument speed', 'IncludeLaunchDescription', 'Node t'])
        self.assertTrue(editor.ask('textDocument/foldingRange', {'textDocument': {'uri': editor.uri('top.launch.py')}}))

    def test_errors_of_the_text(self):
        editor = self.editor()
        editor.open('top.launch.py', PYTHON)
        self.assertEqual(editor.diagnostics('top.launch.py'), [])
        wrong = PYTHON.replace('name=', 'nmae=').replace("'demo'", "'dmeo'").replace('import Node', 'import Nodee')
        editor.change('top.launch.py', {'text': wrong})
        self.assertEqual([(one['code'], one['message']) for one in editor.diagnostics('top.launch.py')],
                         [('LF0005', "launch_ros.actions has no 'Nodee'\ndid you mean 'Node'?")])
        wrong = PYTHON.replace('name=', 'nmae=').replace("'demo'", "'dmeo'")
        editor.change('top.launch.py', {'text': wrong})
        found = editor.diagnostics('top.launch.py')
        self.assertEqual([(one['code'], one['message'].split('\n')[0]) for one in found],
                         [('LF0005', "Node has no argument 'nmae'"), ('LF0301', "package 'dmeo' was not found")])
        [fix] = editor.ask('textDocument/codeAction', {'textDocument': {'uri': editor.uri('top.launch.py')}, 'range': found[0]['range'],
                                                       'context': {'diagnostics': found[:1]}})
        self.assertEqual(fix['title'], "Change to 'name'")
        editor.change('top.launch.py', {'text': PYTHON + 'def broken(:\n    pass\n'})
        [found] = editor.diagnostics('top.launch.py')
        self.assertEqual((found['message'], found['range']['start']['line']), ('SyntaxError: invalid syntax', PYTHON.count('\n')))

    def test_errors_of_the_syntax(self):
        editor = self.editor()
        for text, message, begin, end in (
                ('x = 1\nreturn x\n', "SyntaxError: 'return' outside function", (1, 0), (1, 8)),
                ("x = '😀' y z\n", 'SyntaxError: invalid syntax', (0, 9), (0, 10)),
                ('\ufeffx = 1\ny = = 2\n', 'SyntaxError: invalid syntax', (1, 4), (1, 5)),
                ('\ufeffx = = 1\n', 'SyntaxError: invalid syntax', (0, 5), (0, 6)),
                ('x = 1\ry = = 2\r', 'SyntaxError: invalid syntax', (1, 4), (1, 5)),
                ("x = 1\nif x:\n    y = 'é\n", 'SyntaxError: unterminated string literal (detected at line 3)', (2, 8), (2, 9))):
            with self.subTest(text=text):
                editor.open('a.launch.py', text)
                [found] = editor.diagnostics('a.launch.py')
                self.assertEqual((found['message'], tuple(found['range']['start'].values()), tuple(found['range']['end'].values())),
                                 (message, begin[::-1], end[::-1]))
        for text in ('x = 1 is 1\n', '\ufeffx = 1\n', "x = '\\d'\n"):  # warnings are no errors
            with self.subTest(text=text):
                editor.open('a.launch.py', text)
                self.assertEqual(editor.diagnostics('a.launch.py'), [])
        editor.open('a.launch.py', f'x = {"(" * 5000}\n')
        self.assertEqual(editor.diagnostics('a.launch.py')[0]['message'], 'SyntaxError: too many nested parentheses')
        editor.open('a.launch.py', f'x = {"-" * 100000}1\n')
        self.assertIn('Error', editor.diagnostics('a.launch.py')[0]['message'])

    def test_nothing_of_an_installation_of_python_runs_before_a_file_does(self):
        (self.directory / 'sitecustomize.py').write_text(f"print('Hello')\nopen('{self.directory}/ran', 'w').close()\n")
        before = os.environ.get('PYTHONPATH')
        os.environ['PYTHONPATH'] = str(self.directory)
        self.addCleanup(lambda: os.environ.pop('PYTHONPATH') if before is None else os.environ.update(PYTHONPATH=before))
        editor = self.editor(options={'runPython': True})
        editor.open('a.launch.py', 'x = = 1\n')
        self.assertEqual([one['message'] for one in editor.diagnostics('a.launch.py')], ['SyntaxError: invalid syntax'])
        (self.directory / 'ran').unlink(missing_ok=True)
        editor.change('a.launch.py', {'text': 'y = = 1\n'})
        self.assertEqual([one['message'] for one in editor.diagnostics('a.launch.py')], ['SyntaxError: invalid syntax'])
        self.assertFalse((self.directory / 'ran').exists())
        # A file that runs has all of Python: `exit` comes from the module `site`.
        editor.open('b.launch.py', PYTHON.replace('HERE = ', 'assert exit\nHERE = '))
        self.assertEqual(editor.diagnostics('b.launch.py'), [])
        self.assertTrue((self.directory / 'ran').exists())
        self.assertEqual(editor.end(), 0)

    def test_nothing_of_the_file_runs(self):
        editor = self.editor()
        editor.open('a.launch.py', f"open('{self.directory}/ran', 'w').close()\n{PYTHON}")
        editor.diagnostics('a.launch.py')
        self.assertFalse((self.directory / 'ran').exists())


class RecordedNames(InADirectory):
    def test_nodes_and_topics_of_a_recorded_run_are_completed(self):
        trace = self.directory / 'trace'
        subprocess.run([os.environ['WRITE_EXAMPLE_TRACE'], trace, '10'], check=True)
        text = '<launch>\n<executable cmd="a"><watch kind="topic" topic=""/><watch kind="node" node=""/></executable>\n<node pkg="p" exec="e"><remap from="" to="x"/></node>\n</launch>'
        for words, options in ((['--from-trace', str(trace)], None), ([], {'fromTrace': str(trace)})):
            with self.subTest(words=words):
                editor = self.editor(*words, options=options)
                editor.open('t.launch.xml', text)
                self.assertIn('/scan', editor.labels('t.launch.xml', 1, column(text, 1, 'topic=""', 7)))
                self.assertIn('/filter', editor.labels('t.launch.xml', 1, column(text, 1, 'node=""', 6)))
                self.assertIn('/points', editor.labels('t.launch.xml', 2, column(text, 2, 'from=""', 6)))
                self.assertEqual(editor.end(), 0)

    def test_what_is_no_trace_is_told(self):
        editor = self.editor('--from-trace', str(self.directory / 'nothing'))
        editor.open('t.launch.xml', '<launch/>')
        self.assertEqual(editor.diagnostics('t.launch.xml'), [])


class QuickFixes(InADirectory):
    def fixes(self, text, code):
        """Titles and results of the actions for the findings of this kind."""
        editor = self.editor()
        editor.open('q.launch.xml', text)
        found = [one for one in editor.diagnostics('q.launch.xml') if one['code'] == code]
        actions = editor.ask('textDocument/codeAction', {'textDocument': {'uri': editor.uri('q.launch.xml')}, 'range': found[0]['range'],
                                                         'context': {'diagnostics': found[:1]}})
        lines = text.split('\n')
        results = {}
        for action in actions:
            [edit] = action['edit']['changes'][editor.uri('q.launch.xml')]
            begin, end = edit['range']['start'], edit['range']['end']
            offset = [sum(len(one) + 1 for one in lines[:place['line']]) + place['character'] for place in (begin, end)]
            results[action['title']] = text[:offset[0]] + edit['newText'] + text[offset[1]:]
        return results

    def test_a_missing_attribute(self):
        self.assertEqual(self.fixes('<launch>\n  <let name="a"/>\n</launch>\n', 'LF0103'),
                         {'Add value=""': '<launch>\n  <let value="" name="a"/>\n</launch>\n'})

    def test_an_unknown_attribute(self):
        fixes = self.fixes('<launch>\n  <log message="a" level="info" colour="red"/>\n</launch>\n', 'LF0101')
        self.assertEqual(fixes['Remove colour'], '<launch>\n  <log message="a" level="info"/>\n</launch>\n')

    def test_what_was_meant_inside_of_a_value(self):
        (self.directory / 'base.launch.xml').write_text(BASE)
        for line, code, title, fixed in (
                ('<log message="a $(var sped) b" level="info"/>', 'LF0201', "Change to 'speed'", '$(var speed)'),
                ('<let name="vra" value=""/><log message="$(var var)" level="info"/>', 'LF0201', "Change to 'vra'", '$(var vra)'),
                ('<log message="$(find-pkg-share dmeo)/x" level="info"/>', 'LF0301', "Change to 'demo'", '$(find-pkg-share demo)/x'),
                ('<node pkg="demo" exec="talkr"/>', 'LF0302', "Change to 'talker'", 'exec="talker"'),
                ('<include file="$(dirname)/bsae.launch.xml"/>', 'LF0001', "Change to 'base.launch.xml'", 'file="$(dirname)/base.launch.xml"')):
            with self.subTest(line=line):
                fixes = self.fixes(f'<launch>\n  <let name="speed" value="1"/>\n  {line}\n</launch>\n', code)
                self.assertIn(title, fixes)
                self.assertIn(fixed, fixes[title])

    def test_a_section_of_a_parameter_file_is_no_name_of_the_launch_file(self):
        (self.directory / 'p.yaml').write_text('ctrl:\n  ros__parameters:\n    a: 1\n')
        fixes = self.fixes('<launch>\n  <node pkg="demo" exec="talker" name="ctrl" namespace="robot1"><param from="$(dirname)/p.yaml"/></node>\n</launch>\n', 'LF0309')
        self.assertEqual(list(fixes), ['Ignore LF0309 here'])

    def test_an_argument_that_nobody_reads(self):
        text = '<launch>\n  <arg name="site" default="hall"/>\n  <log message="a" level="info"/>\n</launch>\n'
        fixes = self.fixes(text, 'LF0501')
        self.assertEqual(fixes['Remove <arg>'], '<launch>\n  <log message="a" level="info"/>\n</launch>\n')
        self.assertEqual(fixes['Ignore LF0501 here'], text.replace('  <arg', '  <!-- launch: ignore LF0501: reason -->\n  <arg'))

    def test_an_argument_that_nobody_declares(self):
        fixes = self.fixes('<launch>\n  <log message="$(var speed)" level="info"/>\n</launch>\n', 'LF0201')
        self.assertEqual(fixes["Declare the argument 'speed'"],
                         '<launch>\n  <arg name="speed"/>\n  <log message="$(var speed)" level="info"/>\n</launch>\n')

    def test_an_argument_without_default(self):
        fixes = self.fixes('<launch>\n  <arg name="a"/>\n  <log message="$(var a)" level="info"/>\n</launch>\n', 'LF0503')
        self.assertIn('  <arg name="a" default=""/>\n', fixes['Add default=""'])

    def test_a_useless_comment(self):
        text = '<launch>\n  <!-- launch: ignore LF0501: reason -->\n  <log message="a" level="info"/>\n</launch>\n'
        self.assertEqual(self.fixes(text, 'LF0109')['Remove the comment'], '<launch>\n  <log message="a" level="info"/>\n</launch>\n')


if __name__ == '__main__':
    unittest.main()
