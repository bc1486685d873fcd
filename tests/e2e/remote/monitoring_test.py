# SPDX-License-Identifier: Apache-2.0
"""The dashboard and the alerts that are installed ask for metrics that `launch serve` has; Prometheus answers each question."""

import http.client
import json
import os
import re
import shutil
import subprocess
import time
import unittest
import urllib.parse
from pathlib import Path

from own_launches import LAUNCH, PATIENCE
from served import Served

SOURCE = Path(os.environ['SOURCE_DIRECTORY'])
FILES = SOURCE / 'programs/serve/monitoring'
DASHBOARD, ALERTS = FILES / 'launch_dashboard.json', FILES / 'launch_alerts.yml'
NAME = re.compile(r'\blaunch_[a-z_]+')
# There may be launches of other tests.
PLACES = {'$__rate_interval': '10s', '$instance': '.*', '$launch': 'monitored.*', '$node': '.*'}
# What only limited processes have.
OF_LIMITS = 'launch_control_group_'


def expressions():
    """Of the panels of the dashboard, by title."""
    for panel in json.loads(DASHBOARD.read_text())['panels']:
        for target in panel.get('targets', []):
            expression = target['expr']
            for place, value in PLACES.items():
                expression = expression.replace(place, value)
            yield panel['title'], expression


def metrics_in(text):
    return {re.sub(r'_(bucket|sum|count)$', '', name) for name in NAME.findall(text)}


class Questions(unittest.TestCase):

    def test_ask_for_documented_metrics(self):
        page = (SOURCE / 'docs/remote.md').read_text()
        documented = set(NAME.findall(page)) | {f'launch_control_group{name}' for name in re.findall(r'`…(_[a-z_]+)`', page)}
        asked = metrics_in(' '.join(expression for _, expression in expressions()) + ''.join(re.findall(r'expr: .*', ALERTS.read_text())))
        self.assertGreater(len(asked), 10)
        self.assertEqual(asked - documented, set())

    def test_no_two_panels_overlap(self):
        taken = {}
        for panel in json.loads(DASHBOARD.read_text())['panels']:
            place = panel['gridPos']
            self.assertLessEqual(place['x'] + place['w'], 24)
            for x in range(place['x'], place['x'] + place['w']):
                for y in range(place['y'], place['y'] + place['h']):
                    self.assertNotIn((x, y), taken, panel['title'])
                    taken[x, y] = panel['title']

    @unittest.skipUnless(shutil.which('promtool'), 'because promtool is not installed')
    def test_promtool_reads_the_alerts(self):
        checked = subprocess.run(['promtool', 'check', 'rules', ALERTS], capture_output=True, text=True, timeout=PATIENCE)
        self.assertEqual(checked.returncode, 0, checked.stdout + checked.stderr)


@unittest.skipUnless(shutil.which('prometheus'), 'because prometheus is not installed')
class Answers(Served):

    def prometheus(self):
        """Asks the service for its metrics each second. Sets `asked`, the port for questions."""
        configuration = self.folder / 'prometheus.yml'
        configuration.write_text(f'global: {{scrape_interval: 1s, evaluation_interval: 1s}}\nrule_files: [{ALERTS}]\n'
                                 f'scrape_configs:\n- job_name: launch\n  static_configs: [{{targets: ["127.0.0.1:{self.port}"]}}]\n')
        server = self.start('prometheus', f'--config.file={configuration}', f'--storage.tsdb.path={self.folder}/store',
                            '--web.listen-address=127.0.0.1:0', '--log.format=logfmt', '--log.level=info')
        self.asked = int(re.search(r':(\d+)', server.lines.wait_for('msg="Listening on"').partition('address=')[2]).group(1))
        server.lines.wait_for('Server is ready')

    def query(self, expression):
        connection = http.client.HTTPConnection('127.0.0.1', self.asked, timeout=PATIENCE)
        connection.request('GET', '/api/v1/query?' + urllib.parse.urlencode({'query': expression}))
        answer = json.loads(connection.getresponse().read())
        connection.close()
        self.assertEqual(answer['status'], 'success', f'{expression}: {answer}')
        return answer['data']['result']

    def wait_for(self, what, ask):
        end = time.monotonic() + PATIENCE
        while not (found := ask()):
            self.assertLess(time.monotonic(), end, f'no answer: {what}')
            time.sleep(0.2)  # Prometheus tells nobody that it has asked
        return found

    def test_each_panel_has_data(self):
        self.start_launch('''<executable name="talker" shell="true" output="both" cmd="echo ready; while :; do read x; done">
            <watch kind="command" cmd="true" interval="0.2"/></executable>
          <executable name="loser" cmd="false"/>
          <node pkg="demo_nodes" exec="talker" name="speaker"/>
          <node pkg="demo_nodes" exec="listener"/>''', name='monitored.launch.xml')
        self.serve('--open-metrics', '--nodes')
        self.prometheus()
        for title, expression in expressions():
            if OF_LIMITS in expression and 'vector' not in expression:
                self.query(expression)
                continue
            with self.subTest(title=title, expression=expression):
                self.wait_for(expression, lambda: self.query(expression))
        [failed] = [expression for title, expression in expressions() if title == 'Failed']
        self.wait_for('the process that has failed', lambda: self.query(failed)[0]['value'][1] == '1')
        alerts = self.wait_for('an alert', lambda: self.query('ALERTS{alertname="LaunchProcessFailed", launch=~"monitored.*"}'))
        self.assertEqual([alert['metric']['process'] for alert in alerts], ['loser-2'])


if __name__ == '__main__':
    unittest.main()
