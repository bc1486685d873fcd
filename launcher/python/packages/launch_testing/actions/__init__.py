# SPDX-License-Identifier: Apache-2.0
"""Actions of test descriptions."""

import signal

import _launch_engine
from launch import _names
from launch._entities import entities
from launch.action import Action
from launch.actions import EmitEvent, ExecuteProcess, RegisterEventHandler, TimerAction
from launch.event_handlers import OnProcessExit
from launch.events import matches_action
from launch.events.process import SignalProcess
from launch.substitutions import FindExecutable


class ReadyToTest(Action):
    """The tests begin when it is visited, and the processes of its traversal have been started."""

    made = []  # all of them

    def __init__(self):
        super().__init__()
        self._callbacks = []
        ReadyToTest.made.append(self)

    def _add_callback(self, callback):
        self._callbacks.append(callback)

    def execute(self, context):
        _launch_engine.run_coroutine(_Readiness(self._callbacks))


class _Readiness:
    """Called when the traversal has been carried out."""

    def __init__(self, callbacks):
        self._callbacks = callbacks

    def describe(self):
        return 'ReadyToTest'

    def _start(self):
        for callback in self._callbacks:
            callback()


class Test(ExecuteProcess):
    """A program that is a test. It is killed when it takes longer than `timeout` seconds."""

    __test__ = False  # it is no class of tests for pytest

    def __init__(self, *, timeout=None, **kwargs):
        super().__init__(**kwargs)
        self._timeout = timeout

    @property
    def timeout(self):
        return self._timeout

    def _tags(self):
        if not self._timeout:
            return super()._tags()
        kill = EmitEvent(event=SignalProcess(signal_number=signal.SIGKILL, process_matcher=matches_action(self)))
        limit = TimerAction(period=self._timeout, actions=[kill])
        end = RegisterEventHandler(OnProcessExit(target_action=self, on_exit=lambda *_: limit.cancel()))
        for action in (kill, limit, end):
            action._made_at = self._made_at
        return [*entities([end, limit]), *super()._tags()]


class GTest(Test):
    """A test program with GoogleTest."""

    def __init__(self, *, path, **kwargs):
        super().__init__(cmd=[path], **kwargs)
        self._path = path

    @property
    def path(self):
        return self._path


class PyTest(Test):
    """A file of tests for pytest."""

    def __init__(self, *, path, **kwargs):
        super().__init__(cmd=[FindExecutable(name='python3'), '-m', 'pytest', path], **kwargs)
        self._path = path

    @property
    def path(self):
        return self._path


_names.one_class_modules(__name__)
_names.same_module(__name__, __name__ + '.ready')
