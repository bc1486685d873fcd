# SPDX-License-Identifier: Apache-2.0
"""Runs launches with their tests in a Python program. The tests run in a thread of their own, the launch in that of the caller."""

import inspect
import threading
import unittest

from launch import LaunchDescription, LaunchDescriptionSource, LaunchService
from launch.actions import IncludeLaunchDescription
from launch_testing._watch import ProcessWatch
from launch_testing.parse_arguments import parse_launch_arguments
from launch_testing.test_result import FailResult, SkipResult, TestResult


class _LaunchEnded(Exception):
    """The launch ended before the tests did."""


def _run_tests(tests):
    return unittest.TextTestRunner(verbosity=2, resultclass=TestResult).run(tests)


class _RunnerWorker:
    """One launch with its tests."""

    def __init__(self, test_run, preamble, arguments, debug):
        self._run = test_run
        self._preamble = preamble
        self._arguments = parse_launch_arguments(arguments)
        self._service = LaunchService(debug=debug)
        self._watch = ProcessWatch()
        self._is_ready = threading.Event()
        self._result = None

    def run(self):
        description, objects = self._run.normalized_test_description(ready_fn=self._is_ready.set)
        self._bind(objects)
        self._service.include_launch_description(LaunchDescription([
            *self._preamble, *self._watch.handlers(),
            IncludeLaunchDescription(LaunchDescriptionSource(description), launch_arguments=self._arguments)]))
        threading.Thread(target=self._run_test, name='launch tests', daemon=True).start()
        self._service.run(shutdown_when_idle=not self._run.markers.get('keep_alive', False))
        if self._result is None:
            print('Processes under test stopped before tests completed\n' + self._watch.output_of_failed(), end='')
            raise _LaunchEnded
        self._result.append(_run_tests(self._run.post_shutdown_tests))
        return self._result

    def _bind(self, objects):
        arguments = {**objects, **self._run.param_args}
        given = {'launch_service': self._service, 'proc_info': self._watch.proc_info, 'proc_output': self._watch.proc_output,
                 'test_args': dict(self._arguments)}
        self._run.bind(self._run.pre_shutdown_tests, given, {**arguments, **given})
        given = {**given, 'proc_info': self._watch.proc_info._proc_info_handler,
                 'proc_output': self._watch.proc_output._io_handler}
        self._run.bind(self._run.post_shutdown_tests, given, {**arguments, **given})

    def _run_test(self):
        if not self._is_ready.wait(self._run.timeout):
            print('Timed out waiting for processes to start up')
        else:
            self._result = _run_tests(self._run.pre_shutdown_tests)
        self._service.shutdown()


class LaunchTestRunner:
    """Runs the launches that LoadTestsFromPythonModule() gives, one after another."""

    def __init__(self, test_runs, launch_file_arguments=[], debug=False):
        self._test_runs = test_runs
        self._arguments = launch_file_arguments
        self._debug = debug

    def generate_preamble(self):
        """Actions for the begin of each launch."""
        return []

    def run(self):
        """The result of each run."""
        results = {}
        for run in self._test_runs:
            if len(self._test_runs) > 1:
                print(f'\nStarting test run {run}')
            try:
                results[run] = _RunnerWorker(run, self.generate_preamble(), self._arguments, self._debug).run()
            except unittest.SkipTest as reason:
                print(f'{run} is skipped: {reason}')
                results[run] = SkipResult(run, str(reason))
            except _LaunchEnded:
                results[run] = FailResult(run, 'Launch stopped before the active tests finished.')
                break  # Ctrl-C, most likely
        return results

    def validate(self):
        """Raises an exception if generate_test_description() does not take the arguments that it would be given."""
        for run in self._test_runs:
            taken = inspect.getfullargspec(inspect.unwrap(run._test_description_function))
            taken = [*taken.args, *taken.kwonlyargs]
            for name in run.param_args:
                if name not in taken:
                    raise Exception('Could not find an argument in generate_test_description matching parametrized argument '
                                    f"'{name}'")
            for name in taken:
                if name not in run.param_args and name != 'ready_fn':
                    raise Exception(f"generate_test_description has unexpected extra argument '{name}'")
