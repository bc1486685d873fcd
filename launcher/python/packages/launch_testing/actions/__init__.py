# SPDX-License-Identifier: Apache-2.0
"""Actions of test descriptions."""

import _launch_engine
from launch.action import Action
from launch import _names


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


_names.one_class_modules(__name__)
_names.same_module(__name__, __name__ + '.ready')
