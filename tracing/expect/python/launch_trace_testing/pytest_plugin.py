# SPDX-License-Identifier: Apache-2.0
"""The fixtures `traced_launch` and `launch_run` of pytest."""

import pytest

from launch_trace_testing import LaunchRun


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_makereport(item):
    report = (yield).get_result()
    if report.failed:
        item.stash[_has_failed] = True


_has_failed = pytest.StashKey()


@pytest.fixture
def launch_run(request, capsys):
    """
    A function that starts a system and gives its LaunchRun; its arguments are those of LaunchRun.

    The system is ended after the test. The files of the run stay if the test has failed.
    """
    runs = []

    def start(file=None, **options):
        runs.append(LaunchRun(file, **options))
        return runs[-1]

    yield start
    for run in runs:
        run.stop()
        if request.node.stash.get(_has_failed, False):
            run.keep()
            with capsys.disabled():
                print(f'\nthe files of the run are in {run.directory}')
    for run in runs:
        run.close()


@pytest.fixture
def traced_launch(launch_run):
    """
    A function that runs a launch file to its end and gives its Trace.

    The end must be good: in time, with the exit code 0 (with 3 a process has failed or crashed, also during the
    shutdown), with no process left running, and without a loss of events. The arguments of the launch file
    are given by their names: traced_launch('system.launch.xml', count=5). `options` are further arguments of LaunchRun.
    """

    def run(file=None, options=None, **arguments):
        running = launch_run(file, arguments={name: str(value) for name, value in arguments.items()}, **(options or {}))
        result = running.wait()
        assert not result.timed_out, f'the system did not end by itself\n{result.out}{result.err}'
        assert result.exit_code == 0, f'the launcher ended with {result.exit_code}\n{result.out}{result.err}'
        assert not result.left, 'processes were left running, and have been ended: ' + '; '.join(result.left)
        trace = running.trace()
        trace.expect_no_loss()
        return trace

    return run
