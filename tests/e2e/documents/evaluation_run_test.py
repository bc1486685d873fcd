# SPDX-License-Identifier: Apache-2.0
"""
A tiny run of `./dev evaluate` with real processes and a real session: its result has the form that its schema says. What it
measures means nothing here, and is not looked at.
"""

import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import jsonschema

SOURCE = Path(os.environ['SOURCE_DIRECTORY'])
BUILD = Path(os.environ['BUILD_DIRECTORY'])


def evaluate(*arguments):
    return subprocess.run((sys.executable, '-B', '-m', 'evaluation', '--programs', BUILD, *arguments), text=True,
                          capture_output=True, cwd=SOURCE, env={**os.environ, 'PYTHONPATH': str(SOURCE / 'tests')})


class Experiment(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.output = Path(cls.folder.name) / 'result'
        steps = ('experiment', 'sessions', 'stack', 'calls', 'local', 'discovery')
        cls.done = evaluate('--preset', 'tiny', *(word for step in steps for word in ('--only', step)),
                            '--no-real-time', '--output', cls.output)

    def result(self):
        self.assertEqual(self.done.returncode, 0, self.done.stderr)
        return json.loads((self.output / 'evaluation.json').read_text())

    def test_says_where_the_result_is(self):
        self.result()
        self.assertEqual(self.done.stdout.splitlines(),
                         [str(self.output / 'evaluation.json'), str(self.output / 'evaluation.html')])
        page = (self.output / 'evaluation.html').read_text()
        self.assertIn('<h2>What tracing adds to a message, beside the paper</h2>', page)

    @unittest.skipIf(os.geteuid() != 0 or 'tracefs' not in Path('/proc/filesystems').read_text(),
                     'the kernel lets only root trace it, and must have tracefs')
    def test_has_the_events_of_the_kernel(self):
        result = self.result()
        names = [figure['name'] for figure in result['figures']]
        self.assertIn("all events, and the kernel's scheduler and interrupts", names, result['left_out'])

    def test_is_like_itself(self):
        self.result()
        file = self.output / 'evaluation.json'
        done = evaluate('--from', file, '--compare', file)
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        self.assertRegex(done.stdout, r'(^|\n)\d+ figures compared, none changed beyond noise\n$')

    def test_goes_into_a_page(self):
        self.result()
        page = Path(self.folder.name) / 'page.md'
        arguments = ('--from', self.output / 'evaluation.json', '--markdown', page)
        page.write_text('nothing\n')
        done = evaluate(*arguments)
        self.assertEqual((done.returncode, done.stderr), (1, (
            f'evaluate: error: {page}: the page has no line "<!-- results: all -->" with '
            '"<!-- end of results -->" below it\n')))
        page.write_text('<!-- results: all -->\n<!-- end of results -->\n')
        self.assertEqual(evaluate(*arguments).returncode, 0)
        self.assertIn('| 3.3 |', page.read_text())

    def test_has_the_form_of_its_schema(self):
        schema = json.loads((SOURCE / 'docs/schema/evaluation.schema.json').read_text())
        jsonschema.Draft202012Validator.check_schema(schema)
        jsonschema.Draft202012Validator(schema).validate(self.result())

    def test_measures_one_and_two_processes_with_and_without_tracing(self):
        experiment = self.result()['experiment']
        self.assertEqual([one['processes'] for one in experiment['combinations']], [2, 1])
        for one in experiment['combinations']:
            # Two generations of two batches of forty messages each.
            self.assertEqual(one['untraced']['messages'] + one['traced']['messages'] + one['missed'], 2 * 2 * 2 * 40)
        self.assertGreater(experiment['trace_bytes'], 10_000)

    def test_measures_what_different_sessions_add(self):
        result = self.result()
        names = {one['name'] for one in result['figures']} | {one['what'] for one in result['left_out']}
        self.assertLessEqual({'all events, three context fields, the default', 'five events: publications, takes, callbacks',
                              'all events, live, over the network'}, names)
        # Those need nothing that a machine may not have.
        self.assertIn('all events, no context fields, as in the paper', {one['name'] for one in result['figures']})


    def figures(self, group):
        return {one['name']: one for one in self.result()['figures'] if one['group'] == group}

    def test_measures_the_stack_beside_its_floors(self):
        for group, floor in (('latency of the stack', 'bare Fast DDS with a wait set'),
                             ('services and actions', '2 round trips on bare Fast DDS'),
                             ('timers and intra-process communication', 'a locked queue'),
                             ('start-up and discovery', 'bare Fast DDS')):
            self.assertIn(floor, {one.get('floor_name') for one in self.figures(group).values()})

    def test_measures_what_a_user_waits_for(self):
        calls = self.figures('services and actions')
        self.assertEqual(list(calls), ['this stack: service, request to response, 1000 Hz, median',
                                       'this stack: action, goal to result, 500 Hz, median'])
        start = self.figures('start-up and discovery')
        times = [start[f'this stack: from the start of a program to its {what}']['value']
                 for what in ('main()', 'first publish()', 'first message in another process')]
        self.assertEqual(times, sorted(times))
        self.assertGreater(start['this stack: 2 nodes, a process each: until all know all']['value'], 0)


class CommandLine(unittest.TestCase):

    def test_refuses_an_unknown_step(self):
        done = evaluate('--only', 'nothing')
        self.assertEqual(done.returncode, 2)
        self.assertIn("argument --only: invalid choice: 'nothing'", done.stderr)

    def test_refuses_a_file_that_is_no_result(self):
        done = evaluate('--from', SOURCE / 'docs/schema/launch.schema.json')
        self.assertEqual((done.returncode, done.stderr), (
            1, f"evaluate: error: {SOURCE / 'docs/schema/launch.schema.json'}: this is no result of ./dev evaluate\n"))

    def test_refuses_a_prefix_without_ros2(self):
        done = evaluate('--with-ros2', SOURCE / 'docs')
        self.assertEqual((done.returncode, done.stderr), (
            1, f"evaluate: error: {SOURCE / 'docs'}: no ROS 2 there: 'share/rclcpp' is missing\n"))

    def test_names_a_program_that_is_not_built(self):
        with tempfile.TemporaryDirectory() as folder:
            done = evaluate('--preset', 'tiny', '--only', 'experiment', '--programs', folder, '--output', folder)
            self.assertEqual(done.returncode, 1)
            self.assertIn(f'evaluate: error: experiment: {folder}/bench/latency_stack is not built\n', done.stderr)


if __name__ == '__main__':
    unittest.main()
