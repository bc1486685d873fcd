# SPDX-License-Identifier: Apache-2.0
"""A trace whose files were cut, emptied, removed or replaced is never taken for a whole one, by none of its readers."""

import os
import random
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from stream_files import packet_ends

PREFIX = Path(os.environ['BUILD_DIRECTORY']) / 'prefix'
MUTATIONS = 150
PATIENCE = 120  # seconds

# What a user of the module sees of a trace: an error, or losses.
PYTHON_READER = '''
import sys
import launch_trace
try:
    for one in launch_trace.Trace(sys.argv[1]):
        if isinstance(one, launch_trace.Loss):
            sys.exit(3)
except launch_trace.TraceError as error:
    sys.exit(str(error))
'''


class Mutations(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.directory = Path(tempfile.mkdtemp(prefix='mutations_test-'))
        cls.addClassCleanup(shutil.rmtree, cls.directory)
        file = cls.directory / 'run.launch.xml'
        file.write_text('''<launch>
          <trace session-name="whole" events-ust="ros2:* ros2_ext:*" subbuffer-size-ust="16384" subbuffer-count-ust="64"/>
          <node pkg="demo_nodes" exec="pong"/>
          <node pkg="demo_nodes" exec="ping" on_exit="shutdown">
            <param name="count" value="100"/>
            <param name="period_ms" value="10"/>
          </node>
        </launch>''')
        environment = {name: value for name, value in os.environ.items() if not name.startswith('ROS_')}
        environment.update(ROS_HOME=str(cls.directory), ROS_TRACE_DIR=str(cls.directory))
        run = subprocess.run([os.environ['LAUNCH_PROGRAM'], '--isolate', file], env=environment, text=True,
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=PATIENCE)
        if run.returncode != 0:
            raise AssertionError(run.stdout)
        cls.whole = cls.directory / 'whole'

    def readers(self, trace):
        """What each reader of a trace is called like, and its command line."""
        programs = PREFIX / 'lib' / 'launch'
        page = self.directory / 'page.html'
        return {
            'report': [programs / 'launch-report', trace],
            'page': [programs / 'launch-report', trace, '--html', page],
            'read': [programs / 'launch-trace-read', trace, '--count'],
            'diff': [programs / 'launch-report', '--diff', self.whole, trace, '--fail-on', 'incomplete'],
            'python': [sys.executable, '-B', '-c', PYTHON_READER, trace],
        }

    def run_reader(self, name, trace):
        module = next((PREFIX / 'lib').glob('python3*/dist-packages'))
        return subprocess.run(self.readers(trace)[name], env={**os.environ, 'PYTHONPATH': str(module)}, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=PATIENCE)

    def test_the_whole_trace_is_not_marked(self):
        for name in self.readers(self.whole):
            run = self.run_reader(name, self.whole)
            self.assertEqual(run.returncode, 0, f'{name}: {run.stdout}')

    def test_what_is_missing_is_marked(self):
        chance = random.Random(1)
        streams = [(index.parent.parent / index.stem, index) for index in sorted(self.whole.rglob('*.idx'))]
        streams = [(stream, index) for stream, index in streams if stream.stat().st_size > 0]
        self.assertTrue(streams)
        trace = self.directory / 'changed'
        unmarked = []
        for number in range(MUTATIONS):
            shutil.rmtree(trace, ignore_errors=True)
            shutil.copytree(self.whole, trace)
            stream, index = (trace / path.relative_to(self.whole) for path in chance.choice(streams))
            what = self.change(stream, index, number, chance)
            names = list(self.readers(trace))
            for name in names if number % 10 == 0 else [names[number % len(names)]]:
                run = self.run_reader(name, trace)
                if run.returncode == 0:
                    unmarked.append(f'{number}: {what}: {name} says {run.stdout[:300]}')
        self.assertEqual(unmarked, [])

    def change(self, stream, index, number, chance):
        """Makes one change, and tells which."""
        metadata = stream.with_name('metadata')
        ends = packet_ends(index)
        kinds = ['cut', 'empty', 'removed', 'a folder', 'removed with its index', 'metadata removed', 'metadata emptied']
        if ends:
            kinds += ['cut at a packet', 'cut at a packet, with its index'] * 3
        kind = kinds[number % len(kinds)]
        size = stream.stat().st_size
        if kind == 'cut':
            os.truncate(stream, chance.randrange(1, size))
        elif kind == 'empty':
            os.truncate(stream, 0)
        elif kind == 'a folder':
            stream.unlink()
            stream.mkdir()
        elif kind.startswith('removed'):
            stream.unlink()
            if kind.endswith('index'):
                index.unlink()
        elif kind == 'metadata removed':
            metadata.unlink()
        elif kind == 'metadata emptied':
            os.truncate(metadata, 0)
        else:
            packet = chance.randrange(len(ends))
            os.truncate(stream, ends[packet])
            if kind.endswith('index'):
                (length,) = struct.unpack_from('>I', index.read_bytes(), 12)
                os.truncate(index, 16 + length * (packet + 1))
        return f'{stream.name} {kind}'


if __name__ == '__main__':
    unittest.main()
