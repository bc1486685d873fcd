# SPDX-License-Identifier: Apache-2.0
"""What a launch file looks up for processes of another machine is looked up there."""

import unittest

from machine_hosts import MachinesTest


class MachineLookups(MachinesTest):
    def setUp(self):
        super().setUp()
        self.arm = self.host('arm')
        # A workspace that only the host has, because its /tmp is its own.
        prefix = self.arm.folder / 'tmp' / 'ws'
        (prefix / 'share/ament_index/resource_index/packages').mkdir(parents=True)
        (prefix / 'share/ament_index/resource_index/packages/demo').touch()
        (prefix / 'share/demo').mkdir(parents=True)
        (prefix / 'lib/demo').mkdir(parents=True)
        program = prefix / 'lib/demo/talker'
        program.write_text('#!/bin/sh\necho "talker: $*"\nfor word; do case "$before" in --params-file) cat "$word";; esac; before="$word"; done\n')
        program.chmod(0o755)
        (prefix / 'share/demo/params.yaml').write_text('/**:\n  ros__parameters:\n    speed: $(var speed 3)\n')
        (prefix / 'setup.bash').write_text('echo sourced\nexport AMENT_PREFIX_PATH=/tmp/ws ROBOT="two words"\n')
        self.machine = f'<machine name="arm" connect="{self.arm.connect()}" setup="/tmp/ws/setup.bash"/>\n'

    def run_file(self, actions):
        return self.launch(self.file(self.machine + actions))

    def test_packages_programs_and_variables(self):
        done = self.run_file('''
            <set_env name="SET_BEFORE" value="yes"/>
            <node pkg="demo" exec="talker" machine="arm" output="screen"
                args="$(find-pkg-share demo) $(exec-in-pkg talker demo) $(env ROBOT) $(env SET_BEFORE) $(find-exec sh)"/>''')
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn('[arm:talker-1] talker: /tmp/ws/share/demo /tmp/ws/lib/demo/talker two words yes /usr/bin/sh --ros-args', done.stdout)

    def test_a_variable_that_is_set_or_removed_without_a_change_here(self):
        self.environment['SAME'] = 'same'
        done = self.run_file('''
            <set_env name="SAME" value="same"/>
            <unset_env name="ROBOT"/>
            <executable cmd="sh -c 'echo $SAME, ${ROBOT-none}'" machine="arm" output="screen"/>''')
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn('same, none', done.stdout)

    def test_parameter_files_and_generated_ones(self):
        done = self.run_file('''
            <node pkg="demo" exec="talker" machine="arm" output="screen">
              <param from="$(find-pkg-share demo)/params.yaml" allow_substs="true"/>
              <param name="colour" value="red"/>
            </node>''')
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn('[arm:talker-1]     speed: 3', done.stdout)
        self.assertIn('[arm:talker-1]     colour: "red"', done.stdout)
        self.assertEqual(list((self.arm.folder / 'tmp').glob('launch-*')), [])

    def test_a_death_is_told_with_the_command_line(self):
        done = self.run_file('''
            <node pkg="demo" exec="talker" machine="arm" launch-prefix="false"><param name="colour" value="red"/></node>''')
        self.assertIn("cmd 'false /tmp/ws/lib/demo/talker --ros-args --params-file <launch_params.yaml on arm>'", done.stdout)

    def test_commands_and_files(self):
        done = self.run_file('''
            <group machine="arm">
              <executable output="screen" cmd="echo $(command hostname) $(file-content /tmp/ws/setup.bash)"/>
            </group>
            <executable output="screen" cmd="echo here: $(command 'echo $(env HOME)')"/>''')
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn('arm\n', done.stdout)
        self.assertIn('export AMENT_PREFIX_PATH=/tmp/ws', done.stdout)
        self.assertIn(f'here: {self.folder}', done.stdout)

    def test_what_is_missing_there_is_an_error_at_its_place(self):
        for actions, error in (
                ('<node pkg="demmo" exec="talker" machine="arm"/>',
                 '''system.launch.xml:3:12: error: package 'demmo' not found on machine 'arm'
    3 | <node pkg="demmo" exec="talker" machine="arm"/>
      |            ^~~~~
      = help: did you mean 'demo'?
'''),
                ('<node pkg="demo" exec="taker" machine="arm"/>',
                 '''system.launch.xml:3:24: error: executable 'taker' not found on the libexec directory '/tmp/ws/lib/demo' of machine 'arm'
    3 | <node pkg="demo" exec="taker" machine="arm"/>
      |                        ^~~~~
      = help: did you mean 'talker'?
'''),
                ('<node pkg="demo" exec="talker" machine="amr"/>',
                 '''system.launch.xml:3:41: error: there is no machine 'amr'
    3 | <node pkg="demo" exec="talker" machine="amr"/>
      |                                         ^~~
      = help: did you mean 'arm'?
'''),
                ('<executable machine="arm" tty="true" cmd="true"/>',
                 '''system.launch.xml:3:32: error: tty="true" works on this machine only, and the process runs on machine 'arm'
    3 | <executable machine="arm" tty="true" cmd="true"/>
      |                                ^~~~
''')):
            with self.subTest(actions):
                done = self.run_file('<executable cmd="echo never" output="screen"/>'[:0] + actions)
                self.assertEqual(done.returncode, 1)
                self.assertTrue(done.stdout.endswith(error), done.stdout)
                self.assertNotIn('process started', done.stdout)

    def test_a_missing_parameter_file_is_told(self):
        done = self.run_file('''
            <node pkg="demo" exec="talker" machine="arm"><param from="/tmp/none.yaml"/></node>''')
        self.assertIn("parameter file path is not a file on machine 'arm': /tmp/none.yaml", done.stdout)
        done = self.run_file('''
            <set_parameters_from_file filename="/tmp/none.yaml"/>
            <node pkg="demo" exec="talker" machine="arm"/>'''.replace('<set_parameters_from_file', '<group machine="arm"><set_parameters_from_file', 1) + '</group>')
        self.assertEqual(done.returncode, 1)
        self.assertNotIn('process started', done.stdout)

    def test_many_nodes_take_few_round_trips(self):
        slow = self.folder / 'slow'
        # A connection on which each direction takes 25 ms.
        slow.write_text('''#!/usr/bin/env python3
import os, select, subprocess, sys, time
process = subprocess.Popen(sys.argv[1:], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
waiting = []
open_ends = {0: process.stdin.fileno(), process.stdout.fileno(): 1}
os.set_blocking(process.stdin.fileno(), True)
while process.stdout.fileno() in open_ends:
    now = time.monotonic()
    left = max(0, waiting[0][0] - now) if waiting else None
    ready, _, _ = select.select(list(open_ends), [], [], left)
    for end in ready:
        data = os.read(end, 65536)
        waiting.append((time.monotonic() + 0.025, end, data))
        if not data:
            waiting[-1] = (time.monotonic() + 0.025, end, b'')
            to = open_ends.pop(end)
            if end == 0:
                waiting[-1] = (time.monotonic() + 0.025, None, b'')
    while waiting and waiting[0][0] <= time.monotonic():
        _, end, data = waiting.pop(0)
        if end is None:
            process.stdin.close()
        elif end == 0:
            os.write(process.stdin.fileno(), data)
        elif data:
            os.write(1, data)
sys.exit(process.wait())
''')
        slow.chmod(0o755)
        nodes = '<node pkg="demo" exec="talker" machine="arm"><param from="$(find-pkg-share demo)/params.yaml"/></node>\n' * 200
        self.machine = f'<machine name="arm" connect="{slow} {self.arm.connect()}" setup="/tmp/ws/setup.bash"/>\n'
        done = self.launch(self.file(self.machine + nodes), '--timing')
        self.assertEqual(done.returncode, 0, done.stdout[-3000:])
        self.assertEqual(done.stdout.count('process has finished cleanly'), 200)
        visit = float([line for line in done.stdout.splitlines() if line.strip().startswith('visit')][0].split()[-2])
        self.assertLess(visit, 200 * 50 / 2)  # a round trip for each would be 10 s


if __name__ == '__main__':
    unittest.main()
