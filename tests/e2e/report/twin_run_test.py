# SPDX-License-Identifier: Apache-2.0
"""`launch twin` of a recorded example: the twin runs, and has the graph and the rates of what was recorded."""

import json
import os
import shutil
import tempfile
import unittest
from pathlib import Path

from own_launch import launch

EXAMPLES = Path(os.environ['SOURCE_DIRECTORY']) / 'launch_examples'


class Twin(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.directory = Path(tempfile.mkdtemp(prefix='twin_run_test-'))
        cls.addClassCleanup(shutil.rmtree, cls.directory)
        cls.launch('--isolate', EXAMPLES / '01_ping_pong.launch.xml', 'count:=40', 'period_ms:=50')
        cls.trace = next((cls.directory / 'traces').glob('ping_pong-*'))

    @classmethod
    def launch(cls, *words, code=0):
        return launch(cls.directory, *words, code=code)

    def graph(self, trace):
        """{callback: its runs}, {topic: (publishers, subscriptions)} of the nodes /ping and /pong."""
        report = json.loads(self.launch('report', trace, '--json').stdout)
        callbacks = {(one['node'], one['owner'], one.get('topic', '')): one for one in report['callbacks']
                     if one['node'] in ('/ping', '/pong') and one['owner'] in ('timer', 'subscription')}
        topics = {one['name']: (one['publishers'], one['subscriptions']) for one in report['topics']
                  if one['name'] in ('/ping', '/pong')}
        return callbacks, topics

    def test_the_twin_has_the_graph_and_the_rates(self):
        folder = self.directory / 'twin'
        # As long as the recording would be 2 s, in which its processes don't start on a busy machine.
        run = self.launch('twin', self.trace, '-o', folder, '--run', '--json', '--duration', '8')
        figures = {one['name']: one for one in json.loads(run.stdout)['figures']}
        self.assertEqual(set(figures), {'/ping, timer 50 ms', '/ping, subscription /pong', '/pong, subscription /ping',
                                        '/ping to /pong, subscription /ping', '/pong to /ping, subscription /pong'})
        for name, one in figures.items():
            with self.subTest(name):
                self.assertGreater(one['run']['count'], 0)
                # The stand-in works as long as the original did. What other programs add to either is anybody's guess.
                if one['kind'] == 'callback':
                    self.assertGreater(one['run']['p50_ns'], 0.1 * one['recorded']['p50_ns'])
        recorded, recorded_topics = self.graph(self.trace)
        of_twin, topics_of_twin = self.graph(next(folder.glob('twin-*')))
        self.assertEqual(topics_of_twin, recorded_topics)
        self.assertEqual(set(of_twin), set(recorded))
        for name, one in of_twin.items():
            with self.subTest(name):
                # On a busy machine the processes of the twin find each other late, so subscriptions run less often.
                self.assertLess(one['rate_hz'], 24)
                self.assertGreater(one['rate_hz'], 16 if one['owner'] == 'timer' else 5)

    def test_a_simulation_of_the_system_as_it_was_has_its_figures(self):
        result = json.loads(self.launch('twin', self.trace, '--json', '--what-if', 'duration(/pong)*3').stdout)
        self.assertEqual(result['version'], 1)
        for one in result['figures']:
            with self.subTest(one['name']):
                if one['kind'] == 'callback':
                    # Runs that the recording has not seen are drawn from its own, so the medians differ a little.
                    self.assertAlmostEqual(one['simulated']['p50_ns'] / one['recorded']['p50_ns'], 1, delta=0.5)
                    factor = 3 if one['name'] == '/pong, subscription /ping' else 1
                    self.assertAlmostEqual(one['what_if']['p50_ns'] / one['simulated']['p50_ns'], factor, delta=0.1 * factor)

    def test_a_simulation_of_many_processes_has_their_figures(self):
        self.launch('--isolate', EXAMPLES / '12_reference_system.launch.xml', 'messages:=60')
        trace = next((self.directory / 'traces').glob('reference_system-*'))
        folder = self.directory / 'many'
        result = json.loads(self.launch('twin', trace, '-o', folder, '--json').stdout)
        description = json.loads((folder / 'twin.json').read_text())
        self.assertEqual([len(description[part]) for part in ('processes', 'nodes', 'executors', 'callbacks')], [24, 24, 24, 36])
        fit = result['simulated_error']
        self.assertGreaterEqual(fit['rows'], 60)
        # How near they are depends on what else the machine did (docs/twin.md); here only that most of them are the system's.
        self.assertGreater(fit['p50_within_10_percent'], fit['rows'] / 2, result)

    def test_writes_what_the_launcher_takes(self):
        folder = self.directory / 'written'
        text = self.launch('twin', self.trace, '-o', folder, '--what-if', 'executor=/pong:multi:3,priority=/ping:10').stdout
        self.assertIn('2 processes, 2 nodes, 2 topics, 3 callbacks, 2 executors', text)
        self.assertIn('a trace does not tell the sizes of messages', text)
        self.launch('check', folder / 'twin.xml')
        description = json.loads((folder / 'twin.json').read_text())
        self.assertEqual(sorted((one['kind'], one['threads'], one['priority']) for one in description['executors']),
                         [('multi', 3, 0), ('single', 1, 10)])

    def test_points_at_a_mistake_in_a_change(self):
        run = self.launch('twin', self.trace, '--what-if', 'executor=/pnog:multi', code=2)
        self.assertIn("--what-if:1:10: error: the twin has no node '/pnog'", run.stderr)
        self.assertIn("did you mean '/pong'?", run.stderr)
        self.assertEqual(run.stdout, '')

    def test_a_size_for_a_topic_that_is_not_there_is_an_error(self):
        run = self.launch('twin', self.trace, '--size', '/pingg=100', code=2)
        self.assertEqual(run.stdout, '')
        self.assertEqual(run.stderr, "launch twin: error: --size: the twin has no topic '/pingg'\n"
                                     "      = help: did you mean '/ping'?\n"
                                     "      = help: see 'launch twin --help'\n")

    def test_says_what_it_cannot_do(self):
        run = self.launch('twin', self.directory, '--run', code=2)
        self.assertIn('-o FOLDER', run.stderr)
        empty = self.directory / 'empty'
        empty.mkdir()
        run = self.launch('twin', empty, code=1)
        self.assertIn('launch twin: error: ', run.stderr)


if __name__ == '__main__':
    unittest.main()
