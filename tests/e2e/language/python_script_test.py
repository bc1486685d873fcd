# SPDX-License-Identifier: Apache-2.0
"""LaunchService in Python programs of users: the launcher is a process of its own, handlers run in the program."""

import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import textwrap
import time
import unittest
from pathlib import Path

LAUNCHER = Path(os.environ['LAUNCH_PROGRAM'])
PACKAGES = LAUNCHER.parent.parent / 'lib/launch/python'
EXAMPLES = Path(os.environ['SOURCE_DIRECTORY']) / 'launch_examples'
PATIENCE = 120  # seconds

HEAD = '''
import asyncio, os, signal, sys, threading
from launch import LaunchDescription, LaunchService
from launch.actions import *
from launch.conditions import IfCondition
from launch.event_handlers import *
from launch.events import Shutdown, matches_action
from launch.events.process import SignalProcess
from launch.substitutions import *
'''


class PythonScriptTest(unittest.TestCase):

    def setUp(self):
        self.directory = Path(tempfile.mkdtemp(prefix='python_script_test-'))
        self.addCleanup(shutil.rmtree, self.directory)
        self.environment = {name: value for name, value in os.environ.items()
                            if not name.startswith('ROS_') and name != 'LAUNCH_PROGRAM'}
        self.environment.update(ROS_HOME=str(self.directory), TMPDIR=str(self.directory), PYTHONPATH=str(PACKAGES),
                                PYTHONDONTWRITEBYTECODE='1')

    def script(self, text):
        path = self.directory / 'script.py'
        path.write_text(HEAD + textwrap.dedent(text))
        return path

    def run_script(self, text, code=0, **environment):
        """Both outputs together."""
        result = subprocess.run([sys.executable, str(self.script(text))], env={**self.environment, **environment},
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=PATIENCE)
        self.assertEqual(result.returncode, code, result.stdout)
        return result.stdout

    def start_script(self, text):
        """The program, and a function that gives the rest of its output up to a match."""
        process = subprocess.Popen([sys.executable, '-u', str(self.script(text))], env=self.environment,
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.wait)
        self.addCleanup(lambda: process.poll() is None and process.kill())

        def until(pattern):
            for line in process.stdout:
                if found := re.search(pattern, line):
                    return found
            self.fail(f'no line matches {pattern}')

        return process, until

    def wait_for_end_of(self, pid):
        end = time.monotonic() + PATIENCE
        while Path(f'/proc/{pid}').exists():
            self.assertLess(time.monotonic(), end, f'process {pid} is still there')
            time.sleep(0.02)

    def test_run(self):
        output = self.run_script('''
            service = LaunchService(argv=['a:=b'])
            assert service.event_loop is None and service.task is None and service.context.argv == ['a:=b']
            service.include_launch_description(LaunchDescription([
                ExecuteProcess(cmd=['echo', 'hello'], output='screen')]))
            assert service.shutdown() is None
            print('code', service.run())
        ''')
        self.assertIn('\n[echo-1] hello\n', output)
        self.assertTrue(output.endswith('\ncode 0\n'), output)

    def test_handlers_run_in_the_program(self):
        output = self.run_script('''
            def told(word):
                print(word, os.getpid() == pid, flush=True)

            def exited(event, context):
                told(f'exit {event.returncode} {event.action is process}')
                return [LogInfo(msg=['after ', LaunchConfiguration('word')]), TimerAction(period=0.0, actions=[
                    OpaqueFunction(function=lambda context: told('timer'))])]

            pid = os.getpid()
            process = ExecuteProcess(cmd=['sh', '-c', 'echo out; echo err >&2; exit 3'], cached_output=True)
            service = LaunchService()
            service.context.launch_configurations['word'] = 'words'
            service.context.register_event_handler(OnProcessStart(on_start=lambda event, context: told('start')))
            service.include_launch_description(LaunchDescription([
                RegisterEventHandler(OnProcessExit(target_action=process, on_exit=exited)),
                RegisterEventHandler(OnProcessIO(on_stdout=lambda event: told(event.text.decode().strip()),
                                                 on_stderr=lambda event: told(event.text.decode().strip()))),
                RegisterEventHandler(OnShutdown(on_shutdown=lambda event, context: told('shutdown'))),
                process]))
            code = service.run()
            print('code', code, process.return_code, process.get_stdout() + process.get_stderr(), service.context.is_shutdown)
        ''')
        lines = output.splitlines()
        for word in ('start True', 'out True', 'err True', 'exit 3 True True', 'timer True', 'shutdown True',
                     'code 0 3 out'):
            self.assertIn(word, lines, output)
        self.assertIn('[INFO] [launch.user]: after words', output)

    def test_an_asyncio_program(self):
        output = self.run_script('''
            async def main():
                service = LaunchService()
                started = asyncio.Event()
                sleeper = ExecuteProcess(cmd=['sleep', '600'])

                async def work(context, word):
                    await started.wait()
                    text = context.perform_substitution(TextSubstitution(text=word))
                    # In one piece: the launcher writes to the same pipe.
                    print(f'coroutine {text} {context.asyncio_loop is asyncio.get_running_loop()}\\n', end='', flush=True)

                service.include_launch_description(LaunchDescription([
                    RegisterEventHandler(OnProcessStart(on_start=lambda event, context: started.set())),
                    sleeper, OpaqueCoroutine(coroutine=work, args=['word'])]))
                run = asyncio.create_task(service.run_async())
                await started.wait()
                assert service.event_loop is asyncio.get_running_loop() and service.task is run
                late = asyncio.Event()
                service.context.register_event_handler(OnProcessExit(on_exit=lambda event, context: late.set()))
                service.include_launch_description(LaunchDescription([ExecuteProcess(cmd=['true'])]))
                await late.wait()
                value = await asyncio.to_thread(service.context.perform_substitution,
                                                PythonExpression(['1 + ', '1']))
                print('thread', value)
                await asyncio.to_thread(service.emit_event, SignalProcess(
                    signal_number=signal.SIGKILL, process_matcher=matches_action(sleeper)))
                print('code', await run, sleeper.return_code)
                await service.run_async()
                print('again')

            asyncio.run(main())
        ''')
        for word in ('coroutine word True', 'thread 2', 'code 0 -9', 'again'):
            self.assertIn(word, output.splitlines(), output)

    def test_it_is_kept_until_shutdown(self):
        output = self.run_script('''
            async def main():
                service = LaunchService()
                done = asyncio.Event()
                service.include_launch_description(LaunchDescription([
                    ExecuteProcess(cmd=['true'], on_exit=[OpaqueFunction(function=lambda context: done.set())])]))
                run = asyncio.create_task(service.run_async(shutdown_when_idle=False))
                await done.wait()
                await asyncio.sleep(0.5)
                print('idle', run.done(), service.context.is_shutdown)
                await service.shutdown()
                print('code', await run)

            asyncio.run(main())
        ''')
        self.assertIn('idle False False', output.splitlines(), output)
        self.assertIn('code 0', output.splitlines(), output)

    def test_several_launches_one_after_another(self):
        output = self.run_script('''
            from launch import Action, Event, EventHandler
            class Mark(Action):
                def execute(self, context):
                    print('mark', context.launch_configurations.get('x'), flush=True)

            for turn in range(2):
                service = LaunchService()
                service.include_launch_description(LaunchDescription([
                    SetLaunchConfiguration('x', str(turn)), Mark(),
                    RegisterEventHandler(EventHandler(matcher=lambda event: isinstance(event, Event) and event.name == 'own',
                                                      entities=[OpaqueFunction(function=lambda context: print('own', flush=True))]))]))
                class Own(Event):
                    name = 'own'
                service.emit_event(Own())
                assert service.run() == 0
        ''')
        lines = [line for line in output.splitlines() if line.startswith(('mark', 'own'))]
        self.assertEqual(lines, ['mark 0', 'own', 'mark 1', 'own'], output)

    def test_included_files(self):
        (self.directory / 'part.launch.xml').write_text(
            '<launch><arg name="who"/><executable cmd="echo xml $(var who) $(eval \'2 * 3\')" output="screen"/></launch>')
        (self.directory / 'part.launch.py').write_text(textwrap.dedent('''
            import os
            from launch import LaunchDescription
            from launch.actions import LogInfo
            def generate_launch_description():
                return LaunchDescription([LogInfo(msg=f'python {os.getpid()} {os.environ["COLOUR"]}')])
        '''))
        output = self.run_script('''
            service = LaunchService()
            here = os.path.dirname(os.path.abspath(__file__))
            service.include_launch_description(LaunchDescription([
                SetEnvironmentVariable('COLOUR', 'blue'),
                IncludeLaunchDescription(here + '/part.launch.xml', launch_arguments=[('who', 'me')]),
                IncludeLaunchDescription(here + '/part.launch.py')]))
            assert service.run() == 0
            print('pid', os.getpid(), 'COLOUR' in os.environ)
        ''')
        self.assertIn('xml me 6\n', output)
        pid = re.search(r'pid (\d+) False', output)[1]
        self.assertIn(f'python {pid} blue\n', output)

    def test_an_error_has_its_place(self):
        output = self.run_script('''
            service = LaunchService()
            service.include_launch_description(LaunchDescription([LogInfo(msg=LaunchConfiguration('colour'))]))
            sys.exit(service.run())
        ''', code=1)
        self.assertRegex(output, r"script\.py:\d+:\d+: error: .*'colour'")
        self.assertIn("LaunchConfiguration('colour')", output)
        output = self.run_script('''
            def fail(event, context):
                raise ValueError('no')
            service = LaunchService()
            service.include_launch_description(LaunchDescription([
                ExecuteProcess(cmd=['true'], on_exit=fail), ExecuteProcess(cmd=['sleep', '600'])]))
            sys.exit(service.run())
        ''', code=1)
        self.assertRegex(output, r'script\.py:\d+:\d+: error: ValueError: no\n')

    def test_one_at_a_time(self):
        output = self.run_script('''
            async def main():
                first, second = LaunchService(), LaunchService()
                run = asyncio.create_task(first.run_async(shutdown_when_idle=False))
                await asyncio.sleep(0)
                try:
                    await second.run_async()
                except RuntimeError as error:
                    print(error)
                first.shutdown()
                await run

            asyncio.run(main())
        ''')
        self.assertIn('a LaunchService runs in this process already; one at a time can', output)

    def test_without_a_launcher(self):
        output = self.run_script('LaunchService().run()', code=1, LAUNCH_PROGRAM='/nonexistent/launch')
        self.assertEqual(output.splitlines()[-1], "RuntimeError: LaunchService needs the program 'launch': LAUNCH_PROGRAM "
                                                  "names '/nonexistent/launch', which can't be run")
        output = self.run_script('print(TextSubstitution(text="x").perform(LaunchService().context))\n'
                                 'print(EnvironmentVariable("ROS_HOME").perform(LaunchService().context))')
        self.assertEqual(output, f'x\n{self.directory}\n')
        result = subprocess.run([str(LAUNCHER), str(self.script('x = 1'))], env={
            **self.environment, 'LAUNCH_OF_SCRIPT': 'nonsense'}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.assertEqual((result.returncode, result.stdout), (
            1, 'launch: error: LAUNCH_OF_SCRIPT is set by LaunchService of Python only, not by hand\n'))

    SLEEPER = '''
        service = LaunchService()
        service.include_launch_description(LaunchDescription([ExecuteProcess(cmd=['sleep', '600'])]))
        print('code', service.run())
    '''

    def test_ctrl_c(self):
        process, until = self.start_script(self.SLEEPER)
        pid = until(r'started with pid \[(\d+)\]')[1]
        os.killpg(process.pid, signal.SIGINT)
        until(r'user interrupted with ctrl-c \(SIGINT\)')
        until('^code 0$')
        self.assertEqual(process.wait(timeout=PATIENCE), 0)
        self.assertFalse(Path(f'/proc/{pid}').exists())

    def test_nothing_survives_the_program(self):
        process, until = self.start_script(self.SLEEPER)
        pid = until(r'started with pid \[(\d+)\]')[1]
        process.kill()
        process.wait(timeout=PATIENCE)
        until('error: the program that has started this launch has ended')
        self.wait_for_end_of(pid)
        self.assertEqual(process.stdout.read().count('error:'), 0)

    def test_nothing_survives_the_launcher(self):
        process, until = self.start_script(self.SLEEPER + '''
        print('the end')
        ''')
        pid = until(r'started with pid \[(\d+)\]')[1]
        with open(f'/proc/{pid}/stat', encoding='utf-8') as file:
            launcher = int(file.read().rpartition(')')[2].split()[1])
        os.kill(launcher, signal.SIGKILL)
        until(r'^code (137|1)$')
        until('the end')
        self.assertEqual(process.wait(timeout=PATIENCE), 0)
        self.wait_for_end_of(pid)

    def test_a_task_that_is_cancelled_ends_the_launch(self):
        output = self.run_script('''
            async def main():
                service = LaunchService()
                started = asyncio.Event()
                service.include_launch_description(LaunchDescription([
                    ExecuteProcess(cmd=['sleep', '600']),
                    RegisterEventHandler(OnProcessStart(on_start=lambda event, context: started.set()))]))
                run = asyncio.create_task(service.run_async())
                await started.wait()
                run.cancel()
                print('code', await run)

            asyncio.run(main())
        ''')
        self.assertIn('code 1', output.splitlines(), output)

    def test_setup_bash_makes_the_packages_known(self):
        script = self.script('import launch_ros.actions; sys.exit(LaunchService().run())')
        environment = {name: value for name, value in self.environment.items() if name != 'PYTHONPATH'}
        words = 'source "$1/setup.bash" && exec "$2" "$3"'
        result = subprocess.run(['bash', '-c', words, 'bash', str(LAUNCHER.parent.parent), sys.executable, str(script)],
                                env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=PATIENCE)
        self.assertEqual(result.returncode, 0, result.stdout)

    def test_the_example(self):
        result = subprocess.run([sys.executable, str(EXAMPLES / '60_script.py')], env=self.environment,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=PATIENCE)
        self.assertEqual(result.returncode, 0, result.stdout)


if __name__ == '__main__':
    unittest.main()
