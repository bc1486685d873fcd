# SPDX-License-Identifier: Apache-2.0
"""A system with six problems: the first screen of `launch report` names each once. Healthy systems have none."""

import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

from own_launch import launch

HERE = Path(__file__).resolve().parent
EXAMPLES = Path(os.environ['SOURCE_DIRECTORY']) / 'launch_examples'
ATTEMPTS = 3  # on a machine that may be too busy

# Kind, what the subject begins with, a part of the figures, a part of the next step.
PROBLEMS = [
    ('dropped_messages', '/burst to /lossy_subscriber', 'pushed out of its queue', 'a longer queue than 1'),
    ('over_budget', 'reaction: /camera -> /fusion -> /brake', 'the budget of 10.0 ms', '--chain /camera /brake'),
    ('blocking_callback', '/hog, timer 500 ms', '/victim, timer 20 ms', 'an executor of its own'),
    ('memory_in_active', '/allocating', 'while it is active', '/allocating, timer 100 ms'),
    ('drifting_timer', '/drifting, timer 100 ms', 'usually called after 104 ms', 'reset()'),
    ('dominating_callback', '/dominating, timer 50 ms', '% of the time', 'an executor of its own'),
]


class Findings(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.directory = Path(tempfile.mkdtemp(prefix='six_problems_test-'))
        cls.addClassCleanup(shutil.rmtree, cls.directory)

    def record(self, name, file, *words):
        home = self.directory / name
        shutil.rmtree(home, ignore_errors=True)
        launch(home, '--isolate', file, *words)
        return next((home / 'traces').iterdir())

    def report(self, trace, *words):
        return subprocess.run([os.environ['LAUNCH_REPORT'], trace, *words], check=True, stdout=subprocess.PIPE,
                              text=True).stdout

    def test_six_problems(self):
        for _ in range(ATTEMPTS):
            wrong = list(self.wrong_about_six_problems())
            if not wrong:
                return
        self.fail_unless_busy('\n'.join(wrong))

    def wrong_about_six_problems(self):
        trace = self.record('six', HERE / 'six_problems.launch.xml', f'worker:={os.environ["SIX_PROBLEMS_WORKER"]}')
        findings = json.loads(self.report(trace, '--json'))['findings']
        screen = self.report(trace)
        by_kind = {one['kind']: one for one in findings}
        for kind, subject, figures, following in PROBLEMS:
            finding = by_kind.get(kind)
            if finding is None:
                yield f'{kind} is not among {findings}'
            elif not (finding['subject'].startswith(subject) and figures in finding['figures']
                      and following in finding['next'] and finding['subject'] in screen):
                yield f'{kind}: {finding}'
        # One cause is one finding.
        for finding in findings:
            if finding['kind'] not in {kind for kind, *_ in PROBLEMS}:
                yield f'one more: {finding}'

    def check_health(self, name, file, *words):
        for attempt in range(ATTEMPTS):
            screen = self.report(self.record(name, file, *words))
            if 'nothing stands out' in screen:
                return
        self.fail_unless_busy(screen)

    def fail_unless_busy(self, what):
        if os.getloadavg()[0] > os.cpu_count():
            self.skipTest(f'skipped, because the machine is too busy to tell what the system does: {what}')
        self.fail(what)

    def test_ping_pong(self):
        self.check_health('ping_pong', EXAMPLES / '01_ping_pong.launch.xml')

    def test_an_action(self):
        self.check_health('action', EXAMPLES / '10_action.launch.xml')

    def test_a_lifecycle(self):
        self.check_health('lifecycle', EXAMPLES / '11_lifecycle.launch.xml')

    def test_a_graph_of_many_nodes(self):
        self.check_health('graph', EXAMPLES / '12_reference_system.launch.xml', 'messages:=20')

    def test_each_kind_is_explained(self):
        kinds = re.findall(r'^([a-z_]+) +[A-Z]', subprocess.run([os.environ['LAUNCH_PROGRAM'], 'explain'], check=True,
                           stdout=subprocess.PIPE, text=True).stdout, re.M)
        self.assertTrue({kind for kind, *_ in PROBLEMS} <= set(kinds), kinds)
        for kind in kinds:
            run = subprocess.run([os.environ['LAUNCH_PROGRAM'], 'explain', kind], check=True, stdout=subprocess.PIPE,
                                 text=True)
            self.assertTrue(run.stdout.startswith(f'{kind}: '), run.stdout)


if __name__ == '__main__':
    unittest.main()
