# SPDX-License-Identifier: Apache-2.0
"""`launch explain`, and that the example of every finding of `launch check` has this finding and no other."""

import json
import os
import re
import subprocess
import tempfile
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

LAUNCH = os.environ['LAUNCH_PROGRAM']
SOURCE = Path(os.environ['SOURCE_DIRECTORY'])

SECTION = re.compile(r'^## (?P<id>LF\d{4}): .*\n\nSeverity: (?P<severity>\w+)\.\n(?P<text>(?:.*\n)*?)(?=^## |\Z)', re.M)
EXAMPLE = re.compile(r'```(?P<language>xml|yaml|python)\n(?P<code>.*?)```', re.S)

# Words that a check needs to have the finding.
FURTHER_WORDS = {'LF0107': ['--strict-ros2'], 'LF0209': ['--enable', 'LF0209'], 'LF0311': ['--strict-ros2'],
                 'LF0406': ['--from-parameters', 'params.yaml'], 'LF0502': ['rat:=1']}


def launch(*words):
    return subprocess.run([LAUNCH, *words], capture_output=True, text=True)


class Explain(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.directory = tempfile.TemporaryDirectory()
        prefix = Path(cls.directory.name)
        index = prefix / 'share/ament_index/resource_index'
        for folder in ('packages', 'rclcpp_components'):
            (index / folder).mkdir(parents=True)
        (index / 'rclcpp_components/composition').write_text('composition::Talker;lib/libtalker.so\n')
        (prefix / 'lib').mkdir()
        (prefix / 'lib/libtalker.so').touch()
        for package, program in (('demo_nodes', 'talker'), ('rclcpp_components', 'component_container'),
                                 ('composition', 'composition')):
            (index / 'packages' / package).touch()
            (prefix / 'lib' / package).mkdir()
            (prefix / 'lib' / package / program).write_text('#!/bin/sh\n')
            (prefix / 'lib' / package / program).chmod(0o755)

    @classmethod
    def tearDownClass(cls):
        cls.directory.cleanup()

    def test_the_page_is_that_of_the_table(self):
        self.assertEqual((SOURCE / 'docs/findings.md').read_text(), launch('explain', '--markdown').stdout,
                         './dev launch explain --markdown > docs/findings.md')

    def test_an_explanation_has_title_text_and_example(self):
        self.assertEqual(launch('explain', 'lf0104').stdout, """\
LF0104: Two things exclude each other (error)

The attributes are correct each by itself, but not together.

Example:

    <launch>
      <log message="hello" if="true" unless="false"/>
    </launch>
""")

    def test_the_list_has_every_id_once_and_in_order(self):
        ids = re.findall(r'^(LF\d{4})  (?:error  |warning)  \S.*$', launch('explain').stdout, re.M)
        self.assertGreater(len(ids), 25)
        self.assertEqual(ids, sorted(set(ids)))

    def test_an_unknown_id_is_an_error_with_a_suggestion(self):
        result = launch('explain', 'LF0199')
        self.assertEqual(result.returncode, 2)
        self.assertEqual(result.stdout, '')
        self.assertEqual(result.stderr,
                         "launch explain: error: no finding has the id 'LF0199'\n      = help: did you mean 'LF0109'?\n"
                         "      = help: see 'launch explain --help'\n")
        self.assertEqual(launch('explain', 'talker').stderr,
                         "launch explain: error: no finding has the id 'talker'\n"
                         "      = help: `launch explain` lists all findings\n"
                         "      = help: see 'launch explain --help'\n")

    def test_every_example_has_its_finding_and_no_other(self):
        sections = list(SECTION.finditer(launch('explain', '--markdown').stdout))
        self.assertGreater(len(sections), 25)
        with ThreadPoolExecutor(4) as pool:
            for id, expected, found in pool.map(self.check_example, sections):
                self.assertEqual(found, [expected], id)

    def check_example(self, section):
        files = EXAMPLE.findall(section['text'])
        with tempfile.TemporaryDirectory() as directory:
            ending = {'python': 'py'}.get(files[0][0], files[0][0])
            path = Path(directory, f'example.launch.{ending}')
            path.write_text(files[0][1])
            if len(files) > 1:
                Path(directory, 'params.yaml').write_text(files[1][1])
            result = subprocess.run(
                [LAUNCH, 'check', '--format', 'json', str(path), *FURTHER_WORDS.get(section['id'], [])],
                capture_output=True, text=True, cwd=directory, env={**os.environ, 'AMENT_PREFIX_PATH': self.directory.name})
            found = [(item['id'], item['severity']) for item in json.loads(result.stdout)]
            return section['id'], (section['id'], section['severity']), found


if __name__ == '__main__':
    unittest.main()
