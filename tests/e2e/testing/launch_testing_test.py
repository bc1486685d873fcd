# SPDX-License-Identifier: Apache-2.0
"""Files of ROS 2's launch_testing, run by `launch_test`."""

import importlib.util
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

LAUNCH_TEST = str(Path(os.environ['LAUNCH_PROGRAM']).parent / 'launch_test')
FILES = Path(os.environ['SOURCE_DIRECTORY']) / 'tests/e2e/testing/launch_testing'
PATIENCE = 300  # seconds


class LaunchTest(unittest.TestCase):

    def setUp(self):
        self.directory = Path(tempfile.mkdtemp(prefix='launch_testing_test-'))
        self.addCleanup(shutil.rmtree, self.directory)
        self.environment = {name: value for name, value in os.environ.items() if not name.startswith('ROS_')}
        self.environment.update(ROS_HOME=str(self.directory), TMPDIR=str(self.directory))

    def run_tests(self, *words, code=0):
        """Both outputs together."""
        result = subprocess.run([LAUNCH_TEST, *map(str, words)], env=self.environment, stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, text=True, timeout=PATIENCE, cwd=FILES)
        self.assertEqual(result.returncode, code, result.stdout)
        return result.stdout

    def results(self, *words, code=0):
        """The output, and {test: outcome or (outcome, message)}."""
        file = self.directory / 'results.xml'
        output = self.run_tests(*words, '--junit-xml', file, code=code)
        root = ElementTree.parse(file).getroot()
        self.assertEqual(int(root.get('tests')), sum(1 for _ in root.iter('testcase')))
        cases = {}
        for suite in root:
            for case in suite:
                name = f"{suite.get('name')}/{case.get('classname').rpartition('.')[2]}.{case.get('name')}"
                cases[name] = (case[0].tag, case[0].get('message')) if len(case) else 'passed'
        return output, cases

    def outcomes(self, file, code=0):
        output, cases = self.results(file, code=code)
        prefix = f'{Path(file).stem}.{Path(file).stem}.launch_tests/'
        for name in cases:
            self.assertTrue(name.startswith(prefix), name)
        return output, {name[len(prefix):]: outcome for name, outcome in cases.items()}

    def test_active_tests_and_tests_after_the_shutdown(self):
        _, outcomes = self.outcomes('good.py')
        self.assertEqual(outcomes, {
            'TestWhileItRuns.test_a_name_may_mean_several': 'passed',
            'TestWhileItRuns.test_names_of_releases': 'passed',
            'TestWhileItRuns.test_of_a_process_that_is_nowhere': 'passed',
            'TestWhileItRuns.test_output_comes': 'passed',
            'TestAfterShutdown.test_exit_codes': 'passed',
            'TestAfterShutdown.test_output_in_its_order': 'passed',
            'TestAfterShutdown.test_output_with_and_without_escapes': 'passed'})

    def test_a_process_that_ends_by_itself_is_not_interrupted(self):
        _, outcomes = self.outcomes('ends_by_itself.py')
        self.assertEqual(outcomes, {'TestAfter.test_it_has_ended_well': 'passed',
                                    'TestAfter.test_it_has_written': 'passed'})

    def test_waiting_for_topics(self):
        self.environment['ROS_DOMAIN_ID'] = str(1 + os.getpid() % 100)
        _, outcomes = self.outcomes('topics.py')
        self.assertEqual(outcomes, {'TestTalker.test_it_talks': 'passed'})

    def test_programs_that_tests_start(self):
        _, outcomes = self.outcomes('started_by_tests.py')
        self.assertEqual(set(outcomes.values()), {'passed'})
        self.assertEqual(len(outcomes), 3)

    def test_processes_that_are_tests(self):
        _, outcomes = self.outcomes('test_actions.py')
        self.assertEqual(set(outcomes.values()), {'passed'})
        self.assertEqual(len(outcomes), 3)

    def run_other(self, *words, code=0, **environment):
        result = subprocess.run([*map(str, words)], env={**self.environment, **environment}, stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, text=True, timeout=PATIENCE, cwd=FILES)
        self.assertEqual(result.returncode, code, result.stdout)
        return result.stdout

    def test_launch_test_runs_such_files(self):
        launcher = os.environ['LAUNCH_PROGRAM']
        results = self.directory / 'results.xml'
        output = self.run_other(launcher, 'test', 'parametrized.py', 'greeting:=bonjour', '--junit', results)
        self.assertIn('OK', output)
        self.assertEqual(int(ElementTree.parse(results).getroot().get('tests')), 9)
        self.run_other(launcher, 'test', 'fails.py', code=1)
        self.assertEqual(self.run_other(launcher, 'test', 'good.py', '--repeat', '2', code=2).splitlines()[0],
                         "launch test: error: 'good.py' is a file of launch_testing: of the options only --junit goes with it")
        self.assertEqual(self.run_other(launcher, 'test', 'good.py', 'system.launch.xml', code=2).splitlines()[0],
                         "launch test: error: 'good.py' is a file of launch_testing: such files run without others")

    def test_the_program_is_a_module(self):
        packages = str(Path(os.environ['LAUNCH_PROGRAM']).parent.parent / 'lib/launch/python')
        for module in ('launch_testing', 'launch_testing.launch_test'):
            output = self.run_other(sys.executable, '-m', module, 'kept_alive.py', PYTHONPATH=packages)
            self.assertIn('OK', output)

    @unittest.skipIf(os.environ.get('SANITIZE') == 'thread', 'python3 cannot load modules with ThreadSanitizer')
    @unittest.skipUnless(importlib.util.find_spec('pytest'), 'pytest is not installed')
    def test_pytest_collects_such_files(self):
        plugins = next((Path(os.environ['LAUNCH_PROGRAM']).parent.parent / 'lib').glob('python3*/dist-packages'))
        pytest = (sys.executable, '-B', '-m', 'pytest', '-p', 'no:cacheprovider', '-ra')
        output = self.run_other(*pytest, 'test_actions.py', PYTHONPATH=str(plugins))
        self.assertRegex(output, r'\n=* 1 passed in ')
        bad = self.directory / 'test_bad.py'
        source = (FILES / 'fails.py').read_text().replace('def generate_test', '@pytest.mark.launch_test\ndef generate_test')
        bad.write_text('import pytest\n' + source)
        output = self.run_other(*pytest, bad, '--launch-args', 'a:=b', PYTHONPATH=str(plugins), code=1)
        self.assertIn('\nFAIL: TestFailures.test_failure\n', output)
        self.assertRegex(output, r'\n=* 1 failed in ')
        plain = self.directory / 'test_plain.py'
        plain.write_text('def test_nothing():\n    pass\n')
        self.assertRegex(self.run_other(*pytest, plain, PYTHONPATH=str(plugins)), r'\n=* 1 passed in ')

    RUNNER = """
import importlib, sys, unittest
from launch_testing.junitxml import unittestResultsToXml
from launch_testing.loader import LoadTestsFromPythonModule
from launch_testing.test_runner import LaunchTestRunner
sys.path.insert(0, '.')
module = importlib.import_module(sys.argv[1])
runs = LoadTestsFromPythonModule(module, name=sys.argv[1])
runner = LaunchTestRunner(runs, launch_file_arguments=sys.argv[2:])
runner.validate()
results = runner.run()
for run, result in results.items():
    print(run, result.wasSuccessful(), result.testsRun, len(result.failures), len(result.errors), len(result.skipped))
root = unittestResultsToXml(name='all', test_results=results).getroot()
print(root.attrib['tests'], sorted({case.get('classname') + '/' + case.get('name') for case in root.iter('testcase')}))
"""

    def run_in_a_program(self, *words):
        """The last lines of what LaunchTestRunner tells."""
        packages = str(Path(os.environ['LAUNCH_PROGRAM']).parent.parent / 'lib/launch/python')
        return self.run_other(sys.executable, '-B', '-c', self.RUNNER, *words, PYTHONPATH=packages)

    def test_a_program_may_run_them(self):
        output = self.run_in_a_program('good')
        self.assertIn('\ngood True 7 0 0 0\n', output)
        self.assertIn("7 ['good.TestAfterShutdown/test_exit_codes', ", output)
        output = self.run_in_a_program('parametrized', 'greeting:=bonjour')
        self.assertIn('\nStarting test run parametrized[two]\n', output)
        self.assertIn('\nparametrized[three] True 3 0 0 0\n', output)
        self.assertIn("9 ['parametrized.TestArguments/test_arguments[one]', ", output)

    def test_a_program_is_told_of_failures(self):
        self.assertIn('\nfails False 3 2 1 0\n', self.run_in_a_program('fails'))
        self.assertIn('\nskipped True 1 0 0 1\n', self.run_in_a_program('skipped'))
        output = self.run_in_a_program('dies_early')
        self.assertIn('Processes under test stopped before tests completed\n', output)
        self.assertRegex(output, r'\ndies_early False \d+ \d+ 0 0\n')

    def test_a_launch_for_each_parameter(self):
        _, cases = self.results('parametrized.py', 'greeting:=bonjour', '--package-name', 'words')
        self.assertEqual(cases, {f'words.parametrized.launch_tests[{word}]/TestArguments.{test}': 'passed'
                                 for word in ('one', 'two', 'three')
                                 for test in ('test_arguments', 'test_asks_outside_of_the_thread_of_the_launch',
                                              'test_with_more_than_one_try')})

    def test_several_files(self):
        _, cases = self.results('kept_alive.py', 'xml_file.py')
        self.assertEqual(cases, {'kept_alive.kept_alive.launch_tests/TestEnd.test_end': 'passed',
                                 'kept_alive.kept_alive.launch_tests/TestAfterwards.test_skipped':
                                     ('skipped', 'nothing to see'),
                                 'xml_file.xml_file.launch_tests/TestSystem.test_output': 'passed',
                                 'xml_file.xml_file.launch_tests/TestExit.test_exit_codes': 'passed'})

    def test_failures_and_errors(self):
        output, outcomes = self.outcomes('fails.py', code=1)
        # The program may get Ctrl-C before it can handle it: Python ends with 1 while it starts, by the signal later.
        # SIGTERM follows where the machine was too busy for that.
        outcome, message = outcomes.pop('TestExit.test_exit_codes')
        self.assertEqual(outcome, 'failure')
        self.assertRegex(message, '^AssertionError: Proc keep_alive_proc-1 exited with code (0|1|-2|-15)$')
        self.assertEqual(outcomes, {
            'TestFailures.test_error': ('error', "KeyError: 'nothing'"),
            'TestFailures.test_failure': ('failure', "AssertionError: Waiting for output timed out: 'never'")})
        # Python 3.13 marks the expression on a line of its own.
        self.assertIn("in test_failure\n    proc_output.assertWaitFor('never', timeout=0.01)\n"
                      "AssertionError: Waiting for output timed out: 'never'\n", re.sub(r'\n *[~^]+(?=\n)', '', output))

    def test_a_system_that_dies_early(self):
        output, outcomes = self.outcomes('dies_early.py', code=1)
        self.assertEqual(outcomes, {'launch.launch': ('failure', 'the launch ended before the tests were completed')})
        self.assertIn("Processes under test stopped before tests completed\nProcess 'mortal-1' exited with 3\n"
                      "##### 'mortal-1' output #####\nlast words\n#############################\n", output)
        self.assertIn('launch_test: dies_early.dies_early.launch_tests: the launch ended before the tests were '
                      'completed\n', output)

    def test_a_system_that_is_never_ready(self):
        output, outcomes = self.outcomes('never_ready.py', code=1)
        self.assertEqual(outcomes, {'launch.launch': ('failure', 'the launch ended before the tests were completed')})
        self.assertIn('Timed out waiting for processes to start up: ReadyToTest was not visited within 0.01 s\n',
                      output)

    def test_results_that_can_not_be_written(self):
        blocked = self.directory / 'a_file'
        blocked.write_text('')
        output = self.run_tests('good.py', '--junit-xml', blocked / 'results.xml', code=1)
        self.assertEqual(output.splitlines()[-1], f"launch_test: error: can't write '{blocked}/results.xml': File exists")
        self.run_tests('good.py', '--junit-xml', self.directory / 'new' / 'results.xml')
        self.assertTrue((self.directory / 'new' / 'results.xml').is_file())

    def test_a_description_without_ready_to_test(self):
        output = self.run_tests('no_ready.py', code=1)
        self.assertIn('no_ready.py:6:1: error: generate_test_description functions must return a LaunchDescription containing a '
                      'ReadyToTest action\n'
                      '    6 | def generate_test_description():\n'
                      '      | ^~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\n', output)

    def test_a_skipped_description(self):
        _, outcomes = self.outcomes('skipped.py')
        self.assertEqual(outcomes, {'launch.launch': ('skipped', 'no robot here')})

    def test_arguments_are_shown(self):
        output = self.run_tests('--show-args', 'parametrized.py')
        self.assertIn("    'greeting':\n        what to say\n        (default: 'hello')\n", output)

    def test_wrong_files(self):
        self.assertEqual(self.run_tests('/nonexistent/test.py', code=1),
                         "launch_test: error: the file '/nonexistent/test.py' does not exist\n"
                         "launch_test: /nonexistent/test.py: the file '/nonexistent/test.py' does not exist\n")
        empty = self.directory / 'empty.py'
        empty.write_text('')
        self.assertIn(f"'{empty}' has no generate_test_description(), which returns a LaunchDescription",
                      self.run_tests(empty, code=1))
        parametrized = self.directory / 'no_values.py'
        text = (FILES / 'parametrized.py').read_text()
        parametrized.write_text(re.sub(r"(@launch_testing\.parametrize\('\w+', )\[[^\]]*\]", r'\1[]', text))
        self.assertNotEqual(parametrized.read_text(), text)
        self.assertIn(f"'{parametrized}' has no test runs: its parametrize() has no values", self.run_tests(parametrized, code=1))
        nothing = self.directory / 'nothing.py'
        nothing.write_text((FILES / 'fails.py').read_text().replace('unittest.TestCase', 'object'))
        self.assertIn('launch_test: nothing.nothing.launch_tests: the file has no tests\n',
                      self.run_tests(nothing, code=1))

    def test_ctrl_c_ends_the_system(self):
        waiting = self.directory / 'waiting.py'
        waiting.write_text((FILES / 'dies_early.py').read_text().replace('echo last words; exit 3', 'echo here; sleep 600'))
        with subprocess.Popen([LAUNCH_TEST, str(waiting)], env=self.environment, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, start_new_session=True) as process:
            lines = iter(process.stdout)
            pid = next(found[1] for found in (re.search(r'started with pid \[(\d+)\]', line) for line in lines) if found)
            os.killpg(process.pid, signal.SIGINT)
            self.assertIn('user interrupted with ctrl-c', ''.join(lines))
            self.assertEqual(process.wait(timeout=PATIENCE), 130)
        self.assertFalse(Path('/proc', pid).exists())


if __name__ == '__main__':
    unittest.main()
