# SPDX-License-Identifier: Apache-2.0
"""
Runs the tests of one launch, inside of the launcher.

The tests run on a thread of their own while the launcher goes on. What they ask of the launch is done by a coroutine on
the launcher's thread. When the active tests have ended, the coroutine shuts the launch down, waits for the end of all
processes, and has the other tests run. Then it ends, and with it the launch.
"""

import asyncio
import json
import os
import sys
import threading
import unittest

import _launch_engine
from launch import LaunchDescription, _coroutines
from launch._entities import entities
from launch.action import Action
from launch.actions import RegisterEventHandler
from launch.event_handlers import OnShutdown
from launch.events import IncludeLaunchDescription, Shutdown
from launch.launch_context import LaunchContext
from launch_testing import _loader, _results
from launch_testing._time_to_end import TimeToEnd
from launch_testing._watch import ProcessWatch


class LaunchServiceOfTests:
    """What a test can ask of the launch that it belongs to. It may be used on the tests' thread."""

    def __init__(self, conductor):
        self._conductor = conductor

    @property
    def context(self):
        return LaunchContext._of_launch()

    def emit_event(self, event):
        if isinstance(event, IncludeLaunchDescription):
            self.include_launch_description(event.launch_description)
        else:
            self._conductor.ask(lambda: self.context.emit_event_sync(event))

    def include_launch_description(self, launch_description):
        self._conductor.ask(lambda: _launch_engine.visit(entities(launch_description)))

    def shutdown(self):
        self.emit_event(Shutdown(reason='a test asked for it'))


class Conductor(Action):
    """The action that runs the tests; the last one of the launch description."""

    def __init__(self, order):
        super().__init__()
        self._results = order['results']
        self._told = {'runs': 1, 'suffix': '', 'cases': [], 'completed': False, 'skipped': None}
        self._is_ready = threading.Event()
        self._active_tests_ended = False
        self._loop = None
        self._requests = None
        self._none_is_left = threading.Event()  # some have run, and all of them have ended
        self._all_ended = None
        self._watch = ProcessWatch(self._on_change)
        self._run = self._load(order)
        self._has_active_tests = self._run.active.countTestCases() > 0

    def _load(self, order):
        module = _loader.load_module(order['file'], order['name'])
        runs = _loader.runs_of(module)
        run = runs[order['run']]
        self._told.update(runs=len(runs), suffix=run.name_suffix)
        return run

    def launch_description(self, test_arguments):
        try:
            description, objects = self._run.launch_description(self._is_ready.set)
        except unittest.SkipTest as reason:
            print(f'the tests are skipped: {reason}', file=sys.stderr)
            self._told.update(completed=True, skipped=str(reason))
            self._tell()
            return LaunchDescription([])
        watch = self._watch
        attributes = {'proc_info': watch.proc_info, 'proc_output': watch.proc_output, 'test_args': test_arguments,
                      'launch_service': LaunchServiceOfTests(self)}
        _loader.bind(self._run.active, attributes, {**objects, **self._run.arguments, **attributes})
        attributes = {**attributes, 'proc_info': watch.proc_info._proc_info_handler,
                      'proc_output': watch.proc_output._io_handler}
        _loader.bind(self._run.post_shutdown, attributes, {**objects, **self._run.arguments, **attributes})
        at_shutdown = RegisterEventHandler(OnShutdown(on_shutdown=self._on_shutdown))
        return LaunchDescription([*watch.handlers(), at_shutdown, description, self])

    # Events of processes, on the launcher's thread.

    def _on_change(self, is_start):
        if is_start:
            self._none_is_left.clear()
        else:
            self._look_for_end()

    def _on_shutdown(self, _event, _context):
        if not self._active_tests_ended:
            self._tell_early_end()

    def _look_for_end(self):
        if not self._watch.running:
            self._none_is_left.set()
        if self._all_ended is not None and not self._watch.running:
            self._all_ended.set()

    # The coroutine, on the launcher's thread.

    def execute(self, context):
        _launch_engine.run_coroutine(self)

    def describe(self):
        return 'the tests'

    def _start(self):
        # The end of all processes is no early end if no test is to see them run.
        _coroutines.start(self._conduct(), self, background=self._has_active_tests and not self._run.keep_alive)

    def ask(self, request):
        """Has the launcher's thread call the function. What comes after the end of the launch is forgotten."""
        self._loop.call_soon_threadsafe(self._requests.put_nowait, request)

    async def _conduct(self):
        self._loop = asyncio.get_running_loop()
        self._requests = asyncio.Queue()
        threading.Thread(target=self._run_active_tests, name='launch tests', daemon=True).start()
        try:
            while True:
                request = await self._requests.get()
                request()
        except asyncio.CancelledError:
            pass
        if not self._active_tests_ended:
            return
        self._all_ended = asyncio.Event()
        self._look_for_end()
        await self._all_ended.wait()
        self._told['cases'] += await self._loop.run_in_executor(None, _results.run, self._run.post_shutdown)
        self._told['completed'] = True
        self._tell()

    def _end(self):
        _coroutines.leave_background()  # the launch waits for the tests that are left
        LaunchContext._of_launch().emit_event_sync(Shutdown(reason='the tests have ended'))

    # The tests' thread.

    def _run_active_tests(self):
        if not self._is_ready.wait(timeout=self._run.ready_timeout):
            print(f'Timed out waiting for processes to start up: ReadyToTest was not visited within '
                  f'{self._run.ready_timeout} s', file=sys.stderr)
        else:
            self._told['cases'] += _results.run(self._run.active)
            self._active_tests_ended = True
            if not self._has_active_tests:
                # The launch is shut down at once. A process that ends by itself, such as `echo`, may do so first.
                TimeToEnd().wait(self._none_is_left, lambda: set(self._watch.running))
        self.ask(self._end)

    # Results.

    def _tell_early_end(self):
        lines = []
        if self._is_ready.is_set():
            lines.append('Processes under test stopped before tests completed\n')
        lines.append(self._watch.output_of_failed())
        sys.stderr.write(''.join(lines))  # in one piece: the thread of the tests writes, too
        self._tell()

    def _tell(self):
        with open(self._results + '.new', 'w', encoding='utf-8') as file:
            json.dump(self._told, file)
        os.rename(self._results + '.new', self._results)


def launch_description_of_order():
    """The launch description of the run that the environment names; see __main__.py."""
    order = json.loads(os.environ.pop('LAUNCH_TESTING_RUN'))
    return Conductor(order).launch_description(order['arguments'])
