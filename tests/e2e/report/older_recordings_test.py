# SPDX-License-Identifier: Apache-2.0
"""
A folder of `ros2 trace` of ROS 2 Iron, without any metadata of a launch: what the report, its files, comparisons and
`launch test --trace` make of it. The system is that of tests/support/trace_writer/example_system.hpp: each cycle has a
message on /scan and one on /points; of 60 of the latter one is taken by nobody.
"""

import csv
import json
import os
import sqlite3
import subprocess
import tempfile
import unittest
from pathlib import Path

CYCLES = 60
TESTS = """<launch>
  <test name="arrives">
    <delivery topic="/scan" from="/sensor" to="/filter" min="60"/>
    <latency topic="/scan" max_ms="1"/>
    <latency nodes="/sensor /filter /display" max_ms="20"/>
    <callback node="/filter" max_ms="10"/>
    <timer_period node="/sensor" period_ms="10" jitter_ms="2"/>
    <event name="ros2:rcl_publisher_init" process="sensor" min="1" max="1"/>
    <event name="ros2:rcl_publisher_init" process="/filter" min="1" max="1"/>
  </test>
  <test name="loses none">
    <delivery topic="/points" max_lost="0"/>
  </test>
</launch>
"""


def write(folder, *words):
    """As `ros2 trace --session-name session` has it."""
    trace = Path(folder) / 'ust' / 'uid' / '1000' / '64-bit'
    trace.parent.mkdir(parents=True)
    subprocess.run([os.environ['WRITE_EXAMPLE_TRACE'], trace, str(CYCLES), *words], check=True, stdout=subprocess.DEVNULL)


def run(*words, code=0):
    result = subprocess.run([os.environ['LAUNCH_PROGRAM'], *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                            text=True, check=False, timeout=120)
    if result.returncode != code:
        raise AssertionError(f'exit code {result.returncode} of {words}\n{result.stdout}{result.stderr}')
    return result.stdout + result.stderr


class OlderRecordings(unittest.TestCase):
    maxDiff = None

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.root = Path(cls.folder.name)
        cls.older = cls.root / 'tracing' / 'session-20230501120000'
        write(cls.older, 'older')
        cls.newer = cls.root / 'newer'
        write(cls.newer)
        cls.blurred = cls.root / 'blurred'
        write(cls.blurred, 'older', 'without_source_timestamps')

    def json_of(self, trace):
        return json.loads(run('report', trace, '--json'))

    def test_the_figures_are_those_of_a_new_recording(self):
        older, newer = self.json_of(self.older), self.json_of(self.newer)
        for topic, new in zip(older['topics'], newer['topics']):
            with self.subTest(topic['name']):
                for key in ('name', 'published', 'received', 'published_only', 'received_only', 'latency', 'rate_hz'):
                    self.assertEqual(topic[key], new[key], key)
                self.assertEqual(topic['estimated'], topic['received'])
                self.assertEqual(topic['unidentified'] + topic['undecided'], 0)
        for subscription, new in zip(older['subscriptions'], newer['subscriptions']):
            with self.subTest(subscription['topic']):
                for key in ('received', 'delivered', 'lost', 'overwritten', 'not_executed', 'latency', 'transport'):
                    self.assertEqual(subscription[key], new[key], key)
        self.assertEqual([chain['response'] for chain in older['chains']], [chain['response'] for chain in newer['chains']])
        self.assertTrue(all(chain['estimated'] for chain in older['chains']))
        self.assertFalse(any(chain['estimated'] for chain in newer['chains']))
        self.assertEqual(older['unknown_messages'], 0)
        self.assertEqual((older['tracetools'], newer['tracetools']), (['6.3.2'], ['8.10.1']))
        self.assertEqual((len(older['remarks']), newer['remarks']), (1, []))

    def test_the_text_marks_estimates(self):
        text = run('report', self.older, '--all')
        self.assertRegex(text, r'(?m)^  /scan ~ +')
        self.assertIn('60 of those received are an estimate: their publication was found by its time', text)
        self.assertIn('The trace has no timestamps of publications (tracetools 6.3.2); ros2_tracing records them from 8.0 '
                      '(ROS 2 Jazzy) on.', text)
        self.assertNotIn('was it started late', text)
        self.assertNotIn('recorded by another version', text)
        self.assertNotIn(' ~', run('report', self.newer, '--all'))

    def test_the_files_mark_estimates(self):
        folder = self.root / 'files'
        folder.mkdir()
        run('report', self.older, '--csv', folder / 'csv', '--sql', folder / 'trace.db', '--html', folder / 'page.html',
            '--perfetto', folder / 'trace.json')
        with (folder / 'csv' / 'messages.csv').open() as rows:
            taken = [row for row in csv.DictReader(rows) if row['taken_ns']]
        self.assertEqual({row['estimated'] for row in taken}, {'1'})
        with sqlite3.connect(folder / 'trace.db') as database:
            kinds = database.execute('SELECT kind, text FROM remarks').fetchall()
        self.assertIn('recording', [kind for kind, _ in kinds])
        page = (folder / 'page.html').read_text()
        self.assertIn('The trace has no timestamps of publications', page)
        self.assertIn('"estimates":[[', page.replace(' ', ''))

    def test_what_can_not_be_told_is_neither_lost_nor_untaken(self):
        report = self.json_of(self.blurred)
        for topic in report['topics']:
            with self.subTest(topic['name']):
                self.assertEqual(topic['unidentified'], topic['received'])
                self.assertEqual(topic['undecided'], topic['received'])
        self.assertEqual(sum(one['lost'] + one['overwritten'] + one['not_executed'] for one in report['subscriptions']), 0)
        self.assertNotIn('dropped_messages', [finding['kind'] for finding in report['findings']])

    def test_it_is_compared_with_others_and_makes_a_baseline(self):
        self.assertIn('no', run('report', '--diff', self.older, self.newer))
        slower = self.root / 'slower'
        write(slower, 'older', 'slow')
        text = run('report', '--diff', self.older, slower)
        self.assertIn('response, median ~', text)
        self.assertIn('~ an estimate: a recording has no timestamps of publications', text)
        self.assertNotIn('duration, median ~', text)
        base = self.root / 'base.json'
        run('report', self.older, '--save-baseline', base)
        run('report', self.older, '--baseline', base, '--json', '--fail-on', 'slower')
        changes = json.loads(run('report', slower, '--baseline', base, '--json'))['changes']
        self.assertEqual({change['kind'] for change in changes if change['estimated']}, {'chain'})

    def test_several_sessions_and_folders_are_read(self):
        report = self.json_of(self.root / 'tracing')
        self.assertEqual(report['error'], None)
        self.assertEqual(len([process for process in report['processes'] if not process['folded']]), 3)

    def launch_file(self, text=TESTS):
        file = self.root / f'{self.id().rsplit(".", 1)[-1]}.launch.xml'
        file.write_text(text)
        return file

    def test_expectations_are_judged(self):
        self.assertRegex(run('test', '--trace', self.older, self.launch_file(), '--name', 'arrives'),
                         r'1 test: 1 passed')
        output = run('test', '--trace', self.older, self.launch_file(), code=1)
        self.assertIn("error: messages of '/points' were lost", output)
        self.assertIn('seen: 59 of 60; an estimate, as publications have no timestamps', output)
        self.assertRegex(output, r'2 tests: 1 passed, 1 failed')

    def test_what_the_trace_does_not_tell_is_an_error_that_says_what_is_needed(self):
        output = run('test', self.launch_file(), '--trace', self.blurred, '-n', 'loses none', code=1)
        self.assertIn('error: the trace does not tell whether this holds', output)
        self.assertIn('the trace was recorded by tracetools 6.3.2, which gives publications no timestamps', output)
        self.assertIn('record it with tracetools 8.0 or later (ROS 2 Jazzy)', output)
        self.assertNotIn('not taken', output)

    def test_what_no_trace_tells_fails_or_is_left_out(self):
        file = self.launch_file("""<launch>
  <executable cmd="sleep 1" name="work"/>
  <test name="mixed">
    <output process="work" text="ready"/>
    <exit process="work"/>
    <delivery topic="/scan"/>
  </test>
</launch>
""")
        output = run('test', file, '--trace', self.newer, code=1)
        self.assertIn(f'{file}:4:6: error: a finished trace does not tell what processes write\n'
                      '    4 |     <output process="work" text="ready"/>\n      |      ^~~~~~\n'
                      '      = help: --skip-others leaves out what a trace does not tell; without --trace, everything is judged', output)
        self.assertIn(f'{file}:5:6: error: a finished trace does not tell how processes end', output)
        self.assertRegex(run('test', file, '--trace', self.newer, '--skip-others'), '1 passed')
        only = self.launch_file('<launch><test name="exits"><exit process="work"/></test></launch>')
        self.assertIn('error: the test expects nothing that a finished trace tells',
                      run('test', only, '--trace', self.newer, '--skip-others', code=1))

    def test_processes_have_the_names_that_the_trace_tells(self):
        file = self.launch_file("""<launch>
  <test name="names">
    <event name="ros2:rcl_init" process="sensor-1" max="1"/>
    <event name="ros2:rcl_init" process="filter"/>
    <event name="ros2:rcl_init" process="dispaly"/>
  </test>
</launch>
""")
        output = run('test', file, '--trace', self.newer, code=1)
        self.assertIn(f"{file}:5:42: error: no process of the trace is named 'dispaly'", output)
        self.assertIn("did you mean 'display'?", output)
        self.assertEqual(output.count('error:'), 1)

    def test_mistakes_are_told(self):
        file = self.launch_file()
        self.assertIn(f"--trace: there is no directory '{self.root}/nothing'",
                      run('test', file, '--trace', self.root / 'nothing', code=2))
        (self.root / 'empty').mkdir()
        output = run('test', file, '--trace', self.root / 'empty', code=1)
        self.assertIn(f"error: the trace can't be read: '{self.root}/empty' is not a trace: ", output)
        self.assertIn('      = help: ', output)
        self.assertIn('--repeat does not go with --trace, which starts nothing',
                      run('test', file, '--trace', self.older, '--repeat', '2', code=2))
        self.assertIn('--skip-others needs --trace DIR', run('test', file, '--skip-others', code=2))
        self.assertRegex(run('test', file, '--trace', self.older, '--list'), r'arrives\n.*loses none')

    def test_results_are_written(self):
        junit = self.root / 'results.xml'
        run('test', self.launch_file(), '--trace', self.older, '--junit', junit, code=1)
        self.assertIn('tests="2"', junit.read_text())


if __name__ == '__main__':
    unittest.main()
