# SPDX-License-Identifier: Apache-2.0
"""Files of ROS 2's launch_pytest and launch_testing_ros, under pytest."""

import importlib.util
import os
import select
import shutil
import subprocess
import sys
import tempfile
import textwrap
import unittest
from pathlib import Path

PACKAGES = Path(os.environ['LAUNCH_PROGRAM']).parent.parent / 'lib/launch/python'
EXAMPLES = Path(os.environ['SOURCE_DIRECTORY']) / 'launch_examples'
PATIENCE = 300  # seconds
DOMAIN = str(1 + os.getpid() % 100)

HEAD = '''
import asyncio
import launch
import launch_pytest
import pytest
from launch import LaunchDescription
from launch.actions import ExecuteProcess
from launch_pytest.actions import ReadyToTest
from launch_pytest.tools import process as tools

def program(words, **options):
    return ExecuteProcess(cmd=['sh', '-c', words], cached_output=True, **options)
'''


class LaunchPytestTest(unittest.TestCase):

    def setUp(self):
        if importlib.util.find_spec('pytest') is None:
            self.skipTest('skipped, because pytest is not installed')
        if os.environ.get('SANITIZE'):
            self.skipTest('skipped, because pytest is not tried with a sanitizer')
        self.directory = Path(tempfile.mkdtemp(prefix='launch_pytest_test-'))
        self.addCleanup(shutil.rmtree, self.directory)
        self.environment = {name: value for name, value in os.environ.items() if not name.startswith('ROS_')}
        self.environment.update(ROS_HOME=str(self.directory), TMPDIR=str(self.directory), PYTHONPATH=str(PACKAGES))

    def run_pytest(self, text, *, code=0, options=(), **environment):
        path = self.directory / 'test_system.py'
        path.write_text(HEAD + textwrap.dedent(text))
        return self.run_file(path, code, *options, **environment)

    def run_file(self, path, code=0, *options, **environment):
        result = subprocess.run([sys.executable, '-B', '-m', 'pytest', '-p', 'no:cacheprovider', '-rA', '-v', *options, str(path)],
                                env={**self.environment, **environment}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                text=True, timeout=PATIENCE, cwd=self.directory)
        self.assertEqual(result.returncode, code, result.stdout)
        return result.stdout

    def assert_outcomes(self, output, **outcomes):
        told = output.splitlines()[-1]
        for name, count in outcomes.items():
            self.assertIn(f' {count} {name}', told, output)
        self.assertEqual(told.count(','), len(outcomes) - 1, output)

    def test_the_example(self):
        self.assert_outcomes(self.run_file(EXAMPLES / '61_launch_pytest.py'), passed=2)

    def test_the_kinds_of_tests(self):
        output = self.run_pytest('''
            talker = program('echo out; echo err >&2; exec sleep 600')
            order = []

            @launch_pytest.fixture
            def system():
                return LaunchDescription([talker, ReadyToTest()]), 'more'

            @pytest.fixture
            def word():
                return 'out'

            @pytest.mark.launch(fixture=system)
            def test_function(system, launch_context, word):
                assert system[1] == 'more'
                tools.assert_output_sync(launch_context, talker, lambda text: _equal(text, word + '\\n'), timeout=60)
                assert tools.wait_for_stderr_sync(launch_context, talker, lambda text: text.startswith('err'), timeout=60)
                assert tools.wait_for_start_sync(launch_context, talker, timeout=60)
                assert not tools.wait_for_exit_sync(launch_context, talker, timeout=0.01)

            @pytest.mark.launch(fixture=system)
            async def test_coroutine(launch_service, launch_context, event_loop):
                assert launch_service.event_loop is event_loop is asyncio.get_running_loop()
                assert launch_service.context is launch_context
                await tools.assert_stderr(launch_context, talker, lambda text: _equal(text, 'err\\n'), timeout=60)
                assert await tools.wait_for_output(launch_context, talker, lambda text: 'out' in text, timeout=60)
                assert await tools.wait_for_start(launch_context, talker, timeout=60)
                assert not await tools.wait_for_exit(launch_context, talker, timeout=0.01)
                with pytest.raises(RuntimeError, match='an async test must await the function without _sync'):
                    tools.wait_for_exit_sync(launch_context, talker, timeout=60)

            @pytest.mark.launch(fixture=system)
            def test_generator(launch_context):
                order.append(talker.return_code)
                yield
                order.append(talker.return_code)
                assert order[-1] == -2

            @pytest.mark.launch(fixture=system)
            async def test_async_generator(launch_context):
                assert launch_context.asyncio_loop is asyncio.get_running_loop()
                yield
                assert talker.return_code == -2

            @pytest.mark.launch(fixture=system, shutdown=True)
            def test_after(launch_context):
                assert talker.return_code == -2 and launch_context.is_shutdown

            @pytest.mark.launch(fixture=system, shutdown=True)
            async def test_after_too():
                assert talker.return_code == -2

            class TestMethods:

                @pytest.mark.launch(fixture=system)
                async def test_method(self, launch_context):
                    assert await tools.wait_for_output(launch_context, talker, lambda text: 'out' in text, timeout=60)

            def test_without_a_launch():
                pass

            def _equal(one, other):
                assert one == other
        ''')
        self.assert_outcomes(output, passed=8)

    def test_a_launch_of_a_module(self):
        output = self.run_pytest('''
            made = []

            @launch_pytest.fixture(scope='module', params=['one', 'two'])
            def system(request):
                made.append(program(f'echo {request.param}; exec sleep 600'))
                return LaunchDescription([made[-1]])

            @pytest.mark.launch(fixture=system, shutdown=True)
            def test_at_the_end():
                assert made[-1].return_code == -2

            @pytest.mark.launch(fixture=system)
            def test_generator():
                assert made[-1].return_code is None
                yield
                assert made[-1].return_code == -2

            @pytest.mark.launch(fixture=system)
            async def test_first(launch_context):
                await tools.assert_output(launch_context, made[-1], _has_a_line, timeout=60)

            def test_number_of_launches():
                assert len(made) in (1, 2)

            def _has_a_line(text):
                assert text.endswith('\\n')
        ''')
        self.assert_outcomes(output, passed=9)
        self.assertRegex(output, r'test_generator\[one\]\[shutdown_test\] PASSED')

    def test_a_launch_that_ends_by_itself(self):
        output = self.run_pytest('''
            echo = program('echo done')

            @launch_pytest.fixture(auto_shutdown=False)
            def system():
                return LaunchDescription([echo])

            @pytest.mark.launch(fixture=system, shutdown=True)
            def test_it_has_written():
                assert echo.get_stdout() == 'done\\n' and echo.return_code == 0
        ''')
        self.assert_outcomes(output, passed=1)

    def test_failures(self):
        output = self.run_pytest('''
            from launch.actions import TimerAction

            silent = program('exec sleep 600')

            @launch_pytest.fixture
            def system():
                return LaunchDescription([silent])

            @launch_pytest.fixture(scope='class')
            def system_of_class():
                return LaunchDescription([silent])

            @launch_pytest.fixture
            def two_actions():
                return LaunchDescription([ReadyToTest(), ReadyToTest()])

            @launch_pytest.fixture
            def nothing():
                return object()

            @launch_pytest.fixture
            def never_ready():
                return LaunchDescription([program('true', on_exit=launch.actions.Shutdown()),
                                          TimerAction(period=600.0, actions=[ReadyToTest()])])

            @pytest.mark.launch(fixture=two_actions)
            def test_two_actions():
                pass

            @pytest.mark.launch(fixture=nothing)
            def test_nothing():
                pass

            @pytest.mark.launch(fixture=never_ready)
            def test_never_ready():
                pass

            @pytest.mark.launch
            def test_no_fixture():
                pass

            @pytest.mark.launch(fixture=system)
            async def test_assertion(launch_context):
                await tools.assert_output(launch_context, silent, _has_word, timeout=0.1)

            @pytest.mark.launch(fixture=system)
            def test_two_yields():
                yield
                yield

            @pytest.mark.launch(fixture=system, shutdown=True)
            def test_generator_with_shutdown():
                yield

            class TestOfClass:

                @pytest.mark.launch(fixture=system_of_class)
                async def test_first_part(self):
                    assert False
                    yield

            def _has_word(text):
                assert 'word' in text
        ''', code=1)
        self.assert_outcomes(output, failed=4, skipped=2, warning=1, errors=3)
        for words in ('containing only one ReadyToTest action',
                      "launch_pytest fixture 'nothing': the return value must be either a launch description or a sequence "
                      'whose first item is one, got object',
                      "launch_pytest fixture 'never_ready': the launch ended before ReadyToTest was visited, with the return "
                      'code 0',
                      '"fixture" keyword argument is required in a pytest.mark.launch() decorator',
                      "assert 'word' in ''",
                      'launch tests using a generator function must stop iteration after yielding once',
                      'generator or async generator based launch test items cannot be marked with shutdown=True',
                      'shutdown test skipped because the test failed before'):
            self.assertIn(words, output)

    def test_output_that_is_not_kept(self):
        output = self.run_pytest('''
            def test_it():
                with pytest.raises(RuntimeError) as error:
                    ExecuteProcess(cmd=['true']).get_stdout()
                assert str(error.value) == 'the output of ExecuteProcess is not kept: make it with cached_output=True'
        ''')
        self.assert_outcomes(output, passed=1)

    def test_topics(self):
        output = self.run_pytest('''
            from launch_testing_ros import MessagePump, WaitForTopics

            talker = ExecuteProcess(cmd=[launch.substitutions.EnvironmentVariable('LAUNCH_PROGRAM'), 'topic', 'pub',
                                         '/words', 'std_msgs/msg/String', '{data: hello}', '-r', '20'])

            @launch_pytest.fixture
            def system():
                return LaunchDescription([talker])

            class String:
                __module__ = 'std_msgs.msg._string'

            @pytest.mark.launch(fixture=system)
            def test_messages():
                with WaitForTopics([('/words', String)], timeout=60) as topics:
                    assert topics.topics_received() == {'/words'} and topics.topics_not_received() == set()
                assert topics.received_messages('/words')[0].data == 'hello'
                assert len(topics.received_messages('/words')) <= 10

            def test_silence():
                with pytest.raises(RuntimeError, match='Did not receive messages on these topics'):
                    with WaitForTopics([('/silence', 'std_msgs/msg/String')], timeout=0.1):
                        pass
                topics = WaitForTopics([('/silence', 'std_msgs/msg/String')], timeout=0.1)
                assert not topics.wait() and topics.topics_not_received() == {'/silence'}
                topics.shutdown()
                with pytest.raises(KeyError, match='No messages received for topic: /silence'):
                    topics.received_messages('/silence')

            def test_errors():
                with pytest.raises(RuntimeError, match='no_such_pkg'):
                    WaitForTopics([('/x', 'no_such_pkg/msg/Nothing')], timeout=60).wait()
                with pytest.raises(TypeError, match='the type of a topic must be a class of messages'):
                    WaitForTopics([('/x', 3)]).wait()
                with pytest.raises(RuntimeError, match='trigger of WaitForTopics is called with a node of rclpy'):
                    WaitForTopics([], trigger=print)

            @pytest.mark.skipif(__import__('importlib').util.find_spec('rclpy') is not None, reason='rclpy is installed')
            def test_without_rclpy():
                with pytest.raises(RuntimeError, match='MessagePump needs the Python package rclpy of ROS 2'):
                    MessagePump(object())
        ''', ROS_DOMAIN_ID=DOMAIN)
        self.assertIn(' 4 passed', output)

    def test_nobody_waits_for_topics_when_the_tests_were_killed(self):
        words = ("from launch_testing_ros import WaitForTopics\n"
                 "topics = WaitForTopics([('/silence', 'std_msgs/msg/String')], timeout=0.01)\n"
                 "topics.wait()\nprint(topics._topics['/silence']._process.pid, flush=True)\ninput()\n")
        with subprocess.Popen([sys.executable, '-B', '-c', words], env={**self.environment, 'ROS_DOMAIN_ID': DOMAIN},
                              stdin=subprocess.PIPE, stdout=subprocess.PIPE) as tests:
            process = os.pidfd_open(int(tests.stdout.readline()))
            self.addCleanup(os.close, process)
            tests.kill()
        self.assertTrue(select.select([process], [], [], PATIENCE)[0])

    def test_filters(self):
        index = self.directory / 'share/ament_index/resource_index/rmw_output_prefixes'
        index.mkdir(parents=True)
        (index / 'rmw_x').write_text('[noise]\n')
        output = self.run_pytest('''
            from launch_testing.tools.output import expected_output_from_file
            from launch_testing_ros.tools import basic_output_filter

            def test_filter(tmp_path):
                text = 'pid 3\\nrc 0\\n[noise] x\\nword\\n'
                assert basic_output_filter()(text) == '[noise] x\\nword\\n'
                assert basic_output_filter(filtered_rmw_implementation='rmw_x')(text) == 'word\\n'
                assert basic_output_filter(filtered_prefixes=[], filtered_patterns=['w.r'])(text) == text[:-5]
                (tmp_path / 'a.txt').write_text('one\\ntwo\\n')
                assert expected_output_from_file(str(tmp_path / 'a')) == ['one', 'two']
                with pytest.raises(RuntimeError, match='could not find output check file'):
                    expected_output_from_file('/nonexistent')
        ''', AMENT_PREFIX_PATH=str(self.directory))
        self.assert_outcomes(output, passed=1)


if __name__ == '__main__':
    unittest.main()
