# SPDX-License-Identifier: Apache-2.0
"""What the report says of threads and of callbacks with the kernel's events is what these events say."""

import collections
import os
import shutil
import sqlite3
import subprocess
import tempfile
import unittest
from pathlib import Path

from own_launch import IS_ROOT, run, started
from scheduler_truth import Scheduler
from served_truth import summary
from table_queries import parts
from trace_truth import Truth, events_of

STATES = '''SELECT vtid, state, begin_ns, end_ns, cpu, other_tid FROM thread_states JOIN threads ON thread = threads.id WHERE vtid = ?'''
CALLBACKS = f'''SELECT vpid, address, {parts("running", "runnable", "blocked")} FROM callback_statistics
  JOIN processes ON process = processes.id'''
FIRST_PROCESSES = 'pid:[4026531836]'


class Scheduling(unittest.TestCase):

    def test_threads_and_callbacks(self):
        if not IS_ROOT:
            self.skipTest("skipped, because the kernel's events need root")
        if os.readlink('/proc/self/ns/pid') != FIRST_PROCESSES:
            self.skipTest('skipped, because this is not the first process id namespace')
        directory = Path(tempfile.mkdtemp(prefix='truth_of_scheduling_test-'))
        self.addCleanup(shutil.rmtree, directory)
        session = f'scheduling-{os.getpid()}'
        file = directory / 'scheduling.launch.xml'
        file.write_text(f'''<launch>
          <trace session-name="{session}" events-kernel="sched_switch sched_waking sched_wakeup sched_wakeup_new"
                 subbuffer-size-kernel="4194304"/>
          <node pkg="demo_nodes" exec="pong"/>
          <node pkg="demo_nodes" exec="ping" on_exit="shutdown"><param name="count" value="100"/><param name="period_ms" value="5"/></node>
        </launch>''')
        # Not in a process id namespace: there the kernel's numbers are others than those of userspace.
        processes = started(run(directory, ['bash', '-c', 'exec "$@"'], ['--isolate', file], 0))
        trace = directory / 'traces'
        rows = directory / 'rows.sqlite'
        subprocess.run([os.environ['LAUNCH_REPORT'], trace, '--sql', rows], check=True)
        scheduler, truth = Scheduler(trace), Truth(events_of(trace))
        with sqlite3.connect(rows) as database:
            compared = 0
            for process in processes:
                # One executor each, in the main thread.
                found = collections.Counter(database.execute(STATES, (process,)))
                self.compare(found, collections.Counter(scheduler.rows(process)))
                compared += sum(found.values())
            self.assertGreater(compared, 100)
            took = collections.defaultdict(lambda: collections.defaultdict(list))
            for one in truth.rows.instances:
                if one.process in processes and one.end is not None:
                    for state, nanoseconds in scheduler.parts(one.thread, one.begin, one.end).items():
                        took[one.process, one.callback][state].append(nanoseconds)
            own = [(*key, *(value for state in ('running', 'runnable', 'blocked') for value in summary(states[state])))
                   for key, states in took.items()]
            found = [row for row in database.execute(CALLBACKS) if row[0] in processes]
            self.compare(collections.Counter(found), collections.Counter(own))
            self.assertGreaterEqual(len(own), 3)
        database.close()

    def compare(self, found, own):
        self.assertEqual(sorted(map(str, own - found)), [])
        self.assertEqual(sorted(map(str, found - own)), [])


if __name__ == '__main__':
    unittest.main()
