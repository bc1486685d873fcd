# SPDX-License-Identifier: Apache-2.0
"""
The whole text that `launch check` prints for launch files: tests/golden/check, FILE and FILE.expected. What is not in
the text is no finding, so the files hold right things beside the wrong ones.

With LAUNCH_UPDATE_GOLDEN=1 the expected texts are written anew; read them before committing.
"""

import json
import os
import re
import subprocess
import tempfile
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

LAUNCH = os.environ['LAUNCH_PROGRAM']
FOLDER = Path(os.environ['SOURCE_DIRECTORY']) / 'tests/golden/check'
UPDATE = 'LAUNCH_UPDATE_GOLDEN' in os.environ

PLUGINS = 'parts::Talker;lib/libparts.so\nparts::Listener;lib/libparts.so\nparts::Lost;lib/liblost.so\n'

CONTAINER = '<node_container pkg="golden_demo" exec="talker" name="box" namespace=""'
# A file of a directory for each kind of mistake: what it holds, and the id of the finding.
MISTAKES = {
    'included file': ('<include file="$(dirname)/nowhere.launch.xml"/>', 'LF0001'),
    'cpus': ('<executable cmd="true" cpus="4-2"/>', 'LF0106'),
    'handler of an unknown process': ('<on_process_exit process="nobody"><shutdown/></on_process_exit>', 'LF0205'),
    'package': ('<node pkg="golden_dem" exec="talker"/>', 'LF0301'),
    'package of a component': (f'{CONTAINER}>'
                               '<composable_node pkg="part" plugin="parts::Talker" name="t"/></node_container>', 'LF0301'),
    'program': ('<node pkg="golden_demo" exec="talkr"/>', 'LF0302'),
    'parameter file': ('<node pkg="golden_demo" exec="talker"><param from="$(dirname)/nowhere.yaml"/></node>', 'LF0304'),
    'parameter file that is no YAML': ('<node pkg="golden_demo" exec="talker"><param from="$(dirname)/no.yaml"/></node>',
                                       'LF0305'),
    'ros__parameters mistyped': ('<node pkg="golden_demo" exec="talker"><param from="$(dirname)/typo.yaml"/></node>', 'LF0305'),
    'plugin': (f'{CONTAINER}><composable_node pkg="golden_parts" plugin="parts::Tlker" name="t"/></node_container>', 'LF0306'),
    'plugin that is loaded later': (f'{CONTAINER}/><load_composable_node target="box"><composable_node pkg="golden_parts" '
                                    'plugin="parts::Tlker" name="t"/></load_composable_node>', 'LF0306'),
    'working directory': ('<executable cmd="true" cwd="/nowhere"/>', 'LF0307'),
    'cpu that is not there': ('<executable cmd="true" cpus="1000"/>', 'LF0308'),
    'name of a node': ('<node pkg="golden_demo" exec="talker" name="my-node"/>', 'LF0401'),
    'namespace': ('<node pkg="golden_demo" exec="talker" namespace="1st"/>', 'LF0401'),
    'remap': ('<node pkg="golden_demo" exec="talker"><remap from="a b" to="c"/></node>', 'LF0402'),
    'remap of a scope': ('<set_remap from="a" to="//c"/>', 'LF0402'),
    'two nodes of a name': (2 * '<node pkg="golden_demo" exec="talker" name="a"/>', 'LF0404'),
    'container that nobody starts': ('<load_composable_node target="boxx"><composable_node pkg="golden_parts" '
                                     'plugin="parts::Talker" name="t"/></load_composable_node>', 'LF0405'),
    'unused argument': ('<arg name="unused" default="1"/>', 'LF0501'),
    'argument that the included file does not declare': ('<include file="$(dirname)/inner.xml"><arg name="sped" value="1"/>'
                                                         '</include>', 'LF0502'),
    'context field': ('<trace session-name="s" context-fields="vpidd"/>', 'LF0601'),
    'event': ('<trace session-name="s" events-ust="ros2:rcl_inti"/>', 'LF0602'),
    'two traces of a name': (2 * '<trace session-name="s"/>', 'LF0603'),
}


class CheckFindings(unittest.TestCase):
    maxDiff = None

    @classmethod
    def setUpClass(cls):
        cls.directory = tempfile.TemporaryDirectory()
        prefix = Path(cls.directory.name) / 'prefix'
        index = prefix / 'share/ament_index/resource_index'
        for folder in ('packages', 'rclcpp_components'):
            (index / folder).mkdir(parents=True)
        for package in ('golden_demo', 'golden_parts'):
            (index / 'packages' / package).touch()
            (prefix / 'share' / package).mkdir()
        (index / 'rclcpp_components/golden_parts').write_text(PLUGINS)
        (prefix / 'lib/golden_demo').mkdir(parents=True)
        (prefix / 'lib/libparts.so').touch()
        talker = prefix / 'lib/golden_demo/talker'
        talker.write_text('#!/bin/sh\n')
        talker.chmod(0o755)
        cls.prefix = str(prefix)

    @classmethod
    def tearDownClass(cls):
        cls.directory.cleanup()

    def check(self, *words):
        return subprocess.run(
            [LAUNCH, 'check', *words], capture_output=True, text=True, timeout=50, cwd=self.directory.name,
            env={'PATH': '/usr/bin:/bin', 'HOME': self.directory.name, 'AMENT_PREFIX_PATH': self.prefix,
                 'LANG': 'C.UTF-8', **{name: os.environ.get(name, '') for name in ('ASAN_OPTIONS', 'LSAN_OPTIONS')}})

    def test_every_finding(self):
        files = sorted(path for path in FOLDER.iterdir() if path.suffix != '.expected' and path.is_file())
        self.assertGreater(len(files), 10)
        with ThreadPoolExecutor(2) as pool:
            results = list(pool.map(lambda path: self.check(str(path)), files))
        for path, result in zip(files, results):
            with self.subTest(path.name):
                self.assertEqual(result.stderr, '')
                # Places of the checkout and the number of this machine's CPUs must not be in the expected text.
                text = result.stdout.replace(f'{path.parent}/', '').replace(self.prefix, 'PREFIX')
                text = text.replace(str(Path(LAUNCH).parent.parent), 'OWN_PREFIX')
                text = re.sub(r'its CPUs are 0 to \d+', 'its CPUs are 0 to N', text)
                expected = Path(f'{path}.expected')
                if UPDATE:
                    expected.write_text(text)
                self.assertEqual(text, expected.read_text())
                self.assertEqual(result.returncode, 0 if ': 0 errors' in text else 1)

    def test_json_and_sarif_have_the_findings_of_all_files(self):
        files = [str(FOLDER / name) for name in ('missing_include.launch.xml', 'remaps.launch.xml')]
        found = json.loads(self.check('--format', 'json', *files, 'nowhere.launch.xml').stdout)
        sarif = json.loads(self.check('--format', 'sarif', *files, 'nowhere.launch.xml').stdout)
        results = sarif['runs'][0]['results']
        self.assertEqual([item['id'] for item in found], [item['ruleId'] for item in results])
        self.assertEqual({item['id'] for item in found}, {'LF0001', 'LF0101', 'LF0302', 'LF0402', 'LF0403'})
        self.assertEqual(sorted({item['id'] for item in found}),
                         [rule['id'] for rule in sarif['runs'][0]['tool']['driver']['rules']])
        self.assertEqual({item['severity'] for item in found}, {item['level'] for item in results})

    def test_a_directory_stands_for_all_launch_files_below_it(self):
        below = Path(self.directory.name) / 'below/launch'
        below.mkdir(parents=True)
        for name in ('b_launch.py', 'a.launch.xml', 'c.launch.yaml', 'no.xml'):
            (below / name).write_text('<')
        text = self.check('below').stdout
        self.assertEqual([Path(line.partition(':')[0]).name for line in text.splitlines() if 'error: ' in line],
                         ['a.launch.xml', 'b_launch.py', 'c.launch.yaml'])
        self.assertTrue(text.endswith('\n3 files: 3 errors, 0 warnings\n'), text)
        (below.parent / 'empty').mkdir()
        self.assertEqual(self.check('below/empty', str(FOLDER / 'remaps.launch.xml')).stdout.partition('\n')[0],
                         "error: there are no launch files in 'below/empty' [LF0001]")
        # A package and a file of it, in a directory that holds a directory of this name.
        (Path(self.directory.name) / 'golden_parts').mkdir()
        (Path(self.prefix) / 'share/golden_parts/x.launch.xml').write_text('<launch/>')
        self.assertEqual(self.check('golden_parts', 'x.launch.xml').stdout, '1 file: 0 errors, 0 warnings\n')

    def test_a_directory_with_a_file_for_each_kind_of_mistake(self):
        folder = Path(self.directory.name) / 'mistakes'
        folder.mkdir()
        (folder / 'no.yaml').write_text('/**:\n  ros__parameters: {a: [1\n')
        (folder / 'typo.yaml').write_text('/**:\n  ros__paramters: {a: 1}\n')
        (folder / 'inner.xml').write_text('<launch><arg name="speed" default="1"/><log message="$(var speed)"/></launch>\n')
        for name, (text, _) in MISTAKES.items():
            (folder / f'{name}.launch.xml').write_text(f'<launch>\n  {text}\n</launch>\n')
        result = self.check('--format', 'json', str(folder))
        self.assertEqual((result.returncode, result.stderr), (1, ''))
        found = {}
        for item in json.loads(result.stdout):
            # A finding in a parameter file is the finding of the launch file that names it.
            file = Path((item['included_from'] or [item['file']])[-1].partition('.launch.xml')[0] + '.launch.xml')
            found.setdefault(file.name.removesuffix('.launch.xml'), []).append(item['id'])
        self.assertEqual(found, {name: [id_] for name, (_, id_) in MISTAKES.items()})


if __name__ == '__main__':
    unittest.main()
