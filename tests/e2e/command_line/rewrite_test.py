# SPDX-License-Identifier: Apache-2.0
"""
The commands that write launch files anew, over all examples: the plans stay the same. LAUNCH_PROGRAM is the launcher.
"""

import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

LAUNCH = os.environ['LAUNCH_PROGRAM']
EXAMPLES = pathlib.Path(__file__).parents[3] / 'launch_examples'
TWINS = sorted(path for ending in ('xml', 'yaml') for path in EXAMPLES.glob(f'*.launch.{ending}'))


class Rewrite(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.directory = pathlib.Path(directory.name)
        self.copy = self.directory / 'examples'
        shutil.copytree(EXAMPLES, self.copy)

    def launch(self, *words):
        return subprocess.run([LAUNCH, *map(str, words)], capture_output=True, text=True, timeout=300,
                              cwd=self.directory, env={**os.environ, 'ROS_LOG_DIR': str(self.directory / 'log')})

    def test_format_changes_layout_only_and_gives_the_same_a_second_time(self):
        for path in TWINS:
            with self.subTest(path=path.name):
                once = self.launch('format', '--print', path)
                self.assertEqual((once.returncode, once.stderr), (0, ''))
                fresh = self.directory / path.name
                fresh.write_text(once.stdout)
                again = self.launch('format', '--check', fresh)
                self.assertEqual((again.returncode, again.stdout), (0, ''))

    def test_check_names_the_files_and_changes_nothing(self):
        shutil.rmtree(self.copy)
        path = self.directory / 'a.launch.xml'
        path.write_text('<launch><log message="a" level="INFO"></log></launch>')
        (self.directory / 'b.launch.xml').write_text('<launch/>\n')
        done = self.launch('format', '--check', '.')
        self.assertEqual((done.returncode, done.stdout), (1, './a.launch.xml\n'))
        self.assertIn('></log>', path.read_text())
        done = self.launch('format', '.')
        self.assertEqual((done.returncode, done.stdout), (0, './a.launch.xml\n'))
        self.assertEqual(path.read_text(), '<launch>\n  <log message="a" level="INFO"/>\n</launch>\n')
        path.write_text('<launch>')
        done = self.launch('format', '--check', '.')
        self.assertEqual(done.returncode, 1)
        self.assertIn("a.launch.xml:1:1: error: <launch> is never closed", done.stderr)
        (self.directory / 'c.launch.py').write_text('x = 1\n')
        done = self.launch('format', 'c.launch.py', 'b.launch.xml')
        self.assertEqual((done.returncode, done.stderr), (1, "launch format: error: 'c.launch.py' is a program: launch format writes XML and YAML\n"))

    def plan(self, path):
        """What the file would do, without places; None if it can't be planned."""
        done = self.launch('--dry-run=json', path)
        return None if done.returncode else self.without_places(json.loads(done.stdout))

    def without_places(self, value):
        if isinstance(value, dict):
            return {key: self.without_places(item) for key, item in value.items() if key != 'source'}
        if isinstance(value, str):  # a place in a text, and the time
            return re.sub(r' \([^()]*:\d+:\d+\)$|\d{14}', '', value)
        return list(map(self.without_places, value)) if isinstance(value, list) else value

    def test_xml_and_yaml_are_converted_into_each_other_with_the_same_plan(self):
        for path in TWINS:
            other = 'yaml' if path.suffix == '.xml' else 'xml'
            with self.subTest(path=path.name):
                path = self.copy / path.name
                fresh = self.copy / f'{path.name}.launch.{other}'
                done = self.launch('convert', path, '--to', other, '--output', fresh)
                self.assertEqual((done.returncode, done.stderr), (0, ''))
                self.assertEqual(self.plan(fresh), self.plan(path))

    def test_python_gets_the_same_plan_or_the_place_of_what_it_has_no_form_for(self):
        converted = 0
        for path in TWINS:
            with self.subTest(path=path.name):
                path = self.copy / path.name
                fresh = self.copy / f'{path.name}.launch.py'
                done = self.launch('convert', path, '--to', 'python', '--output', fresh)
                if done.returncode:
                    self.assertIn('error: launch convert knows no form in Python for', done.stderr)
                    self.assertFalse(fresh.exists())
                else:
                    converted += 1
                    self.assertEqual(self.plan(fresh), self.plan(path))
        self.assertGreater(converted, 20)

    def test_a_file_is_never_overwritten(self):
        (self.directory / 'a.launch.xml').write_text('<launch/>')
        (self.directory / 'a.launch.yaml').write_text('mine')
        done = self.launch('convert', 'a.launch.xml', '--to', 'yaml')
        self.assertEqual((done.returncode, done.stderr),
                         (1, "launch convert: error: 'a.launch.yaml' exists\n"
                          '      = help: --output names another file, --print writes none\n'))

    def test_migrate_writes_a_new_file_beside_that_of_ros1(self):
        (self.directory / 'a.launch').write_text('<launch>\n<node pkg="a" type="b" name="c"/><test/></launch>')
        done = self.launch('migrate', 'a.launch')
        self.assertEqual((done.returncode, done.stdout), (1, 'a.launch.xml\n'))
        self.assertIn("a.launch:2:35: warning: 'test' is not known to ROS 2\n", done.stderr)
        self.assertEqual((self.directory / 'a.launch.xml').read_text(),
                         '<launch>\n  <node pkg="a" exec="b" name="c"/>\n  <test/>\n</launch>\n')


if __name__ == '__main__':
    unittest.main()
