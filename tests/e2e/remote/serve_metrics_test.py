# SPDX-License-Identifier: Apache-2.0
"""`launch serve`: what a monitoring system is told, read by the parsers of Prometheus where they are installed."""

import re
import shutil
import subprocess
import unittest

from own_launches import LAUNCH, PATIENCE
from served import TOKEN, Served

try:
    from prometheus_client.openmetrics.parser import text_string_to_metric_families
except ImportError:
    text_string_to_metric_families = None

OPEN_METRICS = 'application/openmetrics-text; version=1.0.0'


class Metrics(Served):
    def metrics(self, token=TOKEN, **header):
        response = self.request('GET', '/metrics', token=token, **header)
        self.assertEqual(response.status, 200, response.text)
        return response

    def test_of_processes(self):
        self.start_launch()
        self.serve()
        response = self.metrics(Accept=OPEN_METRICS)
        self.assertEqual(response.getheader('Content-Type'), 'application/openmetrics-text; version=1.0.0; charset=utf-8')
        self.assertIn('launch_process_up{launch="system.launch.xml",process="talker-1"} 1\n', response.text)
        self.assertTrue(response.text.endswith('\n# EOF\n'))

    def test_the_token_is_wanted_unless_metrics_are_open(self):
        self.serve()
        self.assertEqual(self.request('GET', '/metrics', token=None).status, 401)
        self.serve('--open-metrics')
        self.metrics(token=None)
        self.assertEqual(self.request('GET', '/api/launches', token=None).status, 401)
        self.assertEqual(self.request('POST', '/metrics', body={}).status, 405)

    def test_metrics_alone_need_no_token_file(self):
        service = self.start(LAUNCH, 'serve', '--listen', '127.0.0.1:0', '--open-metrics')
        line = service.lines.wait_for('metrics at ')
        self.port = int(re.search(r':(\d+)/metrics, until Ctrl-C$', line).group(1))
        self.metrics(token=None)
        self.assertEqual(self.request('GET', '/api/launches', token=None).status, 401)

    @unittest.skipUnless(text_string_to_metric_families, 'because python3-prometheus-client is not installed')
    def test_the_parser_of_openmetrics_reads_them(self):
        launch = self.start_launch()
        self.serve()
        families = {family.name: family for family in text_string_to_metric_families(self.metrics(Accept=OPEN_METRICS).text)}
        self.assertEqual(families['launch_process_cpu_seconds'].unit, 'seconds')
        # There may be launches of other tests.
        [info] = [sample for sample in families['launch_info'].samples if sample.labels['pid'] == str(launch.pid)]
        self.assertEqual({sample.labels['process'] for sample in families['launch_process_up'].samples
                          if sample.labels['launch'] == info.labels['launch']}, {'talker-1', 'sleeper-2'})

    @unittest.skipUnless(shutil.which('promtool'), 'because promtool is not installed')
    def test_promtool_finds_nothing_wrong(self):
        self.start_launch()
        self.serve()
        checked = subprocess.run(['promtool', 'check', 'metrics'], input=self.metrics().text, text=True, timeout=PATIENCE,
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.assertEqual((checked.returncode, checked.stdout), (0, ''))


if __name__ == '__main__':
    unittest.main()
