# SPDX-License-Identifier: Apache-2.0
"""One launch file over several hosts: output, exits, order, respawn, handlers, stopping."""

import re
import signal
import unittest

from machine_hosts import MARK, MachinesTest

ANNOUNCE = r'''sh -c 'echo I am `hostname`; echo trouble &gt;&amp;2' '''


class Machines(MachinesTest):
    def setUp(self):
        super().setUp()
        self.arm, self.base = self.host('arm'), self.host('base')
        self.declared = (f'<machine name="arm" connect="{self.arm.connect()}"/>\n'
                         f'<machine name="base" connect="{self.base.connect()}"/>\n')

    def run_file(self, actions, *words):
        return self.launch(self.file(self.declared + actions), *words)

    def test_processes_run_where_the_file_says(self):
        done = self.run_file(f'''
            <executable name="one" machine="arm" output="screen" cmd="{ANNOUNCE}"/>
            <group machine="base">
              <executable name="two" output="screen" cmd="{ANNOUNCE}"/>
              <executable name="three" machine="local" output="screen" cmd="sh -c 'echo `hostname` is not base'"/>
            </group>''')
        self.assertEqual(done.returncode, 0, done.stdout)
        lines = done.stdout.splitlines()
        for line in ('[arm:one-1] I am arm', '[arm:one-1] trouble', '[base:two-2] I am base'):
            self.assertIn(line, lines)
        self.assertTrue([line for line in lines if line.startswith('[three-3] ') and line != '[three-3] base is not base'], done.stdout)
        self.assertRegex(done.stdout, r'\[INFO\] \[arm:one-1\]: process started with pid \[\d+\]')
        self.assertRegex(done.stdout, r'\[INFO\] \[base:two-2\]: process has finished cleanly \[pid \d+\]')

    def test_exit_codes_and_signals_arrive(self):
        done = self.run_file('''
            <executable name="code" machine="arm" cmd="sh -c 'exit 7'"/>
            <executable name="crash" machine="base" cmd="sh -c 'kill -SEGV $$'"/>
            <executable name="fine" machine="base" allowed-exit-codes="3" cmd="sh -c 'exit 3'"/>''')
        self.assertEqual(done.returncode, 3, done.stdout)
        self.assertRegex(done.stdout, r"\[ERROR\] \[arm:code-1\]: process has died \[pid \d+, exit code 7, cmd 'sh -c exit 7'\]")
        self.assertRegex(done.stdout, r"\[ERROR\] \[base:crash-2\]: process has died \[pid \d+, exit code -11,")
        self.assertIn('[base:fine-3]: process has finished with exit code 3, which is allowed', done.stdout)

    def test_a_process_that_can_not_start_is_told_as_one_here(self):
        done = self.run_file('''
            <executable name="missing" machine="arm" cmd="no-such-program"/>
            <executable name="nowhere" machine="arm" cwd="/no/such/directory" cmd="true"/>''')
        self.assertEqual(done.returncode, 3)
        self.assertIn("[arm:missing-1]: exception occurred while executing process: no program 'no-such-program' in the PATH of the "
                      'process: No such file or directory (system.launch.xml:5:', done.stdout)
        self.assertIn("[arm:nowhere-2]: exception occurred while executing process: ", done.stdout)

    def test_order_and_handlers_cross_machines(self):
        done = self.run_file('''
            <executable name="first" machine="arm" output="screen" cmd="sh -c 'echo first is ready; exec sleep 1000'"/>
            <executable name="second" machine="base" output="screen" cmd="sh -c 'echo second runs'">
              <depends_on process="first" condition="output" pattern="is ready"/>
            </executable>
            <on_process_exit process="second">
              <executable name="third" machine="arm" output="screen" cmd="sh -c 'echo third runs'"/>
            </on_process_exit>
            <on_process_exit process="third"><shutdown reason="all is done"/></on_process_exit>''')
        order = [done.stdout.find(text) for text in ('[arm:first-1] first is ready', 'second runs', 'third runs')]
        self.assertEqual(order, sorted(order), done.stdout)
        self.assertNotIn(-1, order)
        self.assertRegex(done.stdout, r"sending signal 'SIGINT' to process\[first-1\]")

    def test_respawn_counts_as_here(self):
        done = self.run_file('''
            <executable name="again" machine="base" respawn="true" respawn_max_retries="2" cmd="sh -c 'exit 4'"/>''')
        self.assertEqual(done.stdout.count('exit code 4,'), 3, done.stdout)
        self.assertEqual(done.returncode, 3)

    def test_a_required_process_ends_the_launch_with_its_code(self):
        done = self.run_file('''
            <executable name="long" machine="arm" cmd="sleep 1000"/>
            <executable name="short" machine="base" required="true" cmd="sh -c 'exit 9'"/>''')
        self.assertEqual(done.returncode, 9, done.stdout)

    def test_the_end_escalates_there(self):
        launch = self.start(self.file(self.declared + '''
            <executable name="stubborn" machine="arm" output="screen" sigterm_timeout="0.3" sigkill_timeout="0.3"
                cmd="sh -c 'trap : INT TERM; echo ready; while :; do sleep 0.1; done'"/>
            <executable name="gentle" machine="base" output="screen"
                cmd="sh -c 'trap &quot;echo bye; exit 0&quot; INT; echo ready; while :; do sleep 0.1; done'"/>'''))
        launch.lines.wait_for('[arm:stubborn-1] ready')
        launch.lines.wait_for('[base:gentle-2] ready')
        launch.send_signal(signal.SIGINT)
        launch.lines.wait_for('[base:gentle-2] bye')
        launch.lines.wait_for("failed to terminate '0.3' seconds after receiving 'SIGINT', escalating to 'SIGTERM'")
        launch.lines.wait_for("escalating to 'SIGKILL'")
        launch.lines.wait_for('[arm:stubborn-1]: process has died')
        launch.wait(60)

    def test_what_a_process_leaves_running_there_is_ended_and_told(self):
        done = self.run_file(f'''
            <executable name="daemon" machine="arm" sigterm_timeout="0.5"
                cmd="sh -c 'setsid sleep 1000 &amp; until grep -qx sleep /proc/$!/comm; do :; done'">
              <env name="{MARK}" value="{self.mark}"/>
            </executable>''')
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertRegex(done.stdout, r"machine 'arm': \[WARNING\] \[launch\]: daemon-1 left 1 process running: sleep \(\d+\); ending it")
        self.assertEqual(self.marked(), {})

    def test_a_flood_arrives_whole_and_holds_up_nobody(self):
        done = self.run_file('''
            <executable name="flood" machine="arm" output="log" cmd="seq 1 300000"/>
            <executable name="calm" machine="arm" output="screen" cmd="sh -c 'echo calm; sleep 0.2; echo still calm'"/>''')
        self.assertEqual(done.returncode, 0, done.stdout[-2000:])
        self.assertIn('[arm:calm-2] still calm', done.stdout)
        log = next(self.folder.glob('log/*/launch.log'))
        numbers = re.findall(r'\[arm:flood-1\] (\d+)$', log.read_text(), re.MULTILINE)
        self.assertEqual(len(numbers), 300000)
        self.assertEqual(numbers, [str(number) for number in range(1, 300001)])

    def test_everything_comes_home(self):
        done = self.run_file(f'<executable name="one" machine="arm" output="screen" cmd="{ANNOUNCE}"/>', '--machine', 'arm=local')
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertNotIn('I am arm', done.stdout)
        self.assertIn('[one-1] I am ', done.stdout)
        done = self.run_file(f'<executable name="one" machine="arm" output="screen" cmd="{ANNOUNCE}"/>', '--machine',
                             f'arm={self.base.connect()}')
        self.assertIn('[arm:one-1] I am base', done.stdout)

    def test_a_machine_of_the_command_line_that_nothing_uses_is_told(self):
        warning = "[WARNING] [launch]: --machine rm: so far the launch has no machine 'rm'; did you mean 'arm'?"
        one = '<executable name="one" machine="arm" output="screen" cmd="true"/>'
        done = self.run_file(one, '--machine', 'rm=local')
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn(warning, done.stdout)
        self.assertNotIn('--machine arm', self.run_file(one, '--machine', 'arm=local').stdout)
        # The command line alone declares it.
        self.assertNotIn('so far', self.run_file(one.replace('"arm"', '"leg"'), '--machine', 'leg=local').stdout)

    def test_another_file_spreads_the_processes(self):
        self.file(self.declared + '''
            <assign_machine machine="arm" process="o*"/>
            <assign_machine machine="base" namespace="/wheels"/>
            <assign_machine machine="base" process="nobody"/>''', 'robot.launch.xml')
        file = self.file('''
            <executable name="one" output="screen" cmd="sh -c 'echo I am `hostname`'"/>
            <group ns="wheels/left"><executable name="two" output="screen" cmd="sh -c 'echo I am `hostname`'"/></group>
            <executable name="three" output="screen" cmd="sh -c 'echo here'"/>''')
        done = self.launch('--machines', 'robot.launch.xml', file)
        self.assertEqual(done.returncode, 0, done.stdout)
        for line in ('[arm:one-1] I am arm', '[base:two-2] I am base', '[three-3] here'):
            self.assertIn(line, done.stdout.splitlines())
        self.assertIn('robot.launch.xml:7:38: no process of the launch fits this', done.stdout)

    def test_yaml_and_python_say_it_as_well(self):
        text = f'''launch:
- machine: {{name: arm, connect: "{self.arm.connect()}"}}
- executable: {{cmd: sh -c 'echo yaml on `hostname`', name: one, machine: arm, output: screen}}
'''
        self.assertIn('[arm:one-1] yaml on arm', self.launch(self.file(text, 'system.launch.yaml')).stdout)
        text = f'''
from launch import LaunchDescription
from launch.actions import ExecuteProcess, GroupAction
from launch_extensions import Machine


def generate_launch_description():
    return LaunchDescription([
        Machine('arm', {self.arm.connect()!r}, keepalive=10),
        ExecuteProcess(cmd=['sh', '-c', 'echo python on `hostname`'], name='one', machine='arm', output='screen'),
        GroupAction([ExecuteProcess(cmd=['sh', '-c', 'echo group on `hostname`'], name='two', output='screen')], machine='arm'),
    ])
'''
        done = self.launch(self.file(text, 'system.launch.py'))
        self.assertIn('[arm:one-1] python on arm', done.stdout, done.stdout)
        self.assertIn('[arm:two-2] group on arm', done.stdout)

    def test_a_dry_run_asks_no_machine(self):
        file = self.file('''
            <machine name="arm" connect="false"/>
            <node pkg="demo" exec="talker" machine="arm" args="$(find-pkg-share demo)/x $(env HOME)"/>
            <executable cmd="true" machine="local"/>''')
        done = self.launch('--dry-run', file)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn('machine: arm', done.stdout)
        self.assertIn('<prefix of demo on arm>/lib/demo/talker', done.stdout)
        self.assertIn('<HOME on arm>', done.stdout)


if __name__ == '__main__':
    unittest.main()
