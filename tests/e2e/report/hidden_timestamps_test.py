# SPDX-License-Identifier: Apache-2.0
"""
A run of ping and pong is read as it was recorded, and with the publisher and the timestamp of rmw_publish hidden, as in
recordings of ROS 2 Iron and before: each message has the same publication, and nothing is told as lost.
"""

import csv
import json
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import own_launch

EXAMPLES = Path(os.environ['SOURCE_DIRECTORY']) / 'launch_examples'


def hide(trace, hidden):
    """A copy of the trace in which the fields have names, of the same length, that nobody looks for."""
    shutil.copytree(trace, hidden)
    for metadata in hidden.rglob('metadata'):
        text = metadata.read_bytes()
        begin = text.index(b'name = "ros2:rmw_publish";')
        end = text.index(b'};', text.index(b'fields', begin))
        event = text[begin:end].replace(b'_rmw_publisher_handle', b'_rmw_publisher_hidden').replace(b'_timestamp', b'_timestomp')
        metadata.write_bytes(text[:begin] + event + text[end:])


def report(trace, *words):
    done = subprocess.run([os.environ['LAUNCH_REPORT'], trace, *words], check=True, stdout=subprocess.PIPE)
    return done.stdout


class HiddenTimestamps(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.directory = Path(tempfile.mkdtemp(prefix='hidden_timestamps_test-'))
        cls.addClassCleanup(shutil.rmtree, cls.directory)
        own_launch.launch(cls.directory, '--isolate', EXAMPLES / '01_ping_pong.launch.xml')
        cls.trace = next((cls.directory / 'traces').glob('ping_pong-*'))
        cls.hidden = cls.directory / 'hidden'
        hide(cls.trace, cls.hidden)

    def messages(self, trace):
        """The publication of each message that was taken, and whether it is an estimate."""
        folder = self.directory / f'{trace.name}.csv'
        report(trace, '--csv', folder)
        with (folder / 'messages.csv').open() as rows:
            taken = [row for row in csv.DictReader(rows) if row['taken_ns']]
        return {(row['subscription'], row['taken_ns']): (row['publisher'], row['published_ns'], row['estimated']) for row in taken}

    def test_each_message_has_its_publication(self):
        truth, found = self.messages(self.trace), self.messages(self.hidden)
        self.assertGreaterEqual(len(truth), 20)
        self.assertEqual({estimated for _, _, estimated in truth.values()}, {'0'})
        self.assertEqual({taken: (publisher, time, '1') for taken, (publisher, time, _) in truth.items()}, found)

    def test_nothing_is_lost_or_unknown(self):
        read = json.loads(report(self.hidden, '--json'))
        self.assertEqual(read['unknown_messages'], 0)
        for one in read['subscriptions']:
            self.assertEqual(one['lost'] + one['overwritten'] + one['not_executed'] + one['unidentified'], 0, one['topic'])


if __name__ == '__main__':
    unittest.main()
