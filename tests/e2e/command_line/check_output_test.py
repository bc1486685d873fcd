# SPDX-License-Identifier: Apache-2.0
"""
The baseline of `launch check`, and its outputs for code hosts. LAUNCH_PROGRAM is the launcher.
"""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

LAUNCH = os.environ['LAUNCH_PROGRAM']
NEVER_READ = '<launch>\n  <arg name="{}" default="1"/>\n</launch>\n'


class CheckOutput(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.directory = pathlib.Path(directory.name)
        (self.directory / 'sub').mkdir()
        self.write('sub/a.launch.xml', NEVER_READ.format('a'))

    def write(self, name, text):
        (self.directory / name).write_text(text, encoding='utf-8')

    def check(self, *words):
        return subprocess.run([LAUNCH, 'check', *words], cwd=self.directory, capture_output=True, text=True, check=False)

    def test_a_baseline_leaves_what_is_new(self):
        written = self.check('--write-baseline', 'known.json', '.')
        self.assertEqual((written.returncode, written.stdout, written.stderr),
                         (0, '', 'launch check: 1 finding written to known.json\n'))
        self.assertEqual(json.loads((self.directory / 'known.json').read_text()), {
            'version': 1, 'findings': [{'file': 'sub/a.launch.xml', 'id': 'LF0501', 'message': "argument 'a' is never read",
                                        'count': 1}]})
        # It moves by a line, and a second one comes.
        self.write('sub/a.launch.xml', '\n' + NEVER_READ.format('a').replace('</launch>', '  <arg name="b" default="1"/>\n</launch>'))
        result = self.check('--baseline', 'known.json', '--werror', 'sub')
        self.assertEqual(result.stdout, "sub/a.launch.xml:4:4: error: argument 'b' is never read [LF0501]\n"
                                        '    4 |   <arg name="b" default="1"/>\n'
                                        '      |    ^~~\n'
                                        '1 file: 1 error, 0 warnings, 1 finding of the baseline\n')
        self.assertEqual(result.returncode, 1)
        self.write('sub/a.launch.xml', '<launch/>')
        result = self.check('--baseline', 'known.json', '--werror', 'sub')
        self.assertEqual((result.stdout, result.returncode),
                         ('1 file: 0 errors, 0 warnings, 0 findings of the baseline (1 of it gone)\n', 0))

    def test_what_is_no_baseline_is_an_error(self):
        self.assertEqual(self.check('--baseline', 'nope.json', '.').stderr,
                         "launch check: error: the baseline 'nope.json' can't be read\n"
                         '      = help: --write-baseline FILE makes one\n')
        for text, why in (('{', 'launch check has not written what it holds'), ('{"version": 2}', 'its version is 2, not 1')):
            self.write('wrong.json', text)
            result = self.check('--baseline', 'wrong.json', '.')
            self.assertEqual((result.returncode, result.stderr),
                             (1, f"launch check: error: 'wrong.json' is no baseline: {why}\n"
                                 '      = help: --write-baseline FILE makes one\n'))
        self.assertEqual(self.check('--write-baseline', 'no/where.json', '.').stderr,
                         "launch check: error: 'no/where.json' can't be written\n")

    def test_annotations_for_github(self):
        self.write('sub/b, 100%.launch.xml', '<launch>\n  <nodde/>\n</launch>\n')
        self.assertEqual(self.check('--format', 'github', 'sub').stdout,
                         '::warning file=sub/a.launch.xml,line=2,endLine=2,col=4,endColumn=7,'
                         "title=LF0501 Argument is never read::argument 'a' is never read\n"
                         '::error file=sub/b%2C 100%25.launch.xml,line=2,endLine=2,col=4,endColumn=9,'
                         "title=LF0101 Unknown name::unrecognized entity of the type 'nodde'%0Adid you mean 'node'?\n")

    def test_a_report_for_gitlab(self):
        report = json.loads(self.check('--format', 'gitlab', '.').stdout)
        self.assertEqual(report, [{'description': "argument 'a' is never read", 'check_name': 'LF0501',
                                   'fingerprint': report[0]['fingerprint'], 'severity': 'minor',
                                   'location': {'path': 'sub/a.launch.xml', 'lines': {'begin': 2}}}])
        self.write('sub/a.launch.xml', '\n\n' + NEVER_READ.format('a'))
        self.assertEqual(json.loads(self.check('--format', 'gitlab', '.').stdout)[0]['fingerprint'], report[0]['fingerprint'])


if __name__ == '__main__':
    unittest.main()
