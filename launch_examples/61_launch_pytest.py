# SPDX-License-Identifier: Apache-2.0
# Tests of a launched system as tests of pytest: pytest 61_launch_pytest.py
import launch
import launch_pytest
import pytest
from launch_pytest.tools import process

TALKER = launch.actions.ExecuteProcess(cmd=['sh', '-c', 'echo ready to work; exec sleep 600'], cached_output=True)


@launch_pytest.fixture
def system():
    return launch.LaunchDescription([TALKER, launch_pytest.actions.ReadyToTest()])


@pytest.mark.launch(fixture=system)
async def test_it_gets_ready(launch_context):
    await process.assert_output(launch_context, TALKER, lambda text: _has('ready', text), timeout=30)


@pytest.mark.launch(fixture=system)
def test_its_end(launch_context):
    assert process.wait_for_output_sync(launch_context, TALKER, lambda text: 'work' in text, timeout=30)
    yield
    assert TALKER.return_code == -2  # SIGINT


def _has(word, text):
    assert word in text
