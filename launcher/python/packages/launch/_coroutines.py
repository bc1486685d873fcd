# SPDX-License-Identifier: Apache-2.0
"""
Coroutines of launch files, on one asyncio loop that the launcher runs in steps.

A step goes on until all coroutines wait. The launcher then waits for the loop's descriptor and time itself.
"""

import asyncio
import selectors

import _launch_engine

_MOST_TURNS = 100  # in one step: a coroutine that never waits must not keep the launcher from its other work


class _Selector(selectors.DefaultSelector):
    """Ends the step where asyncio would wait."""

    def __init__(self):
        super().__init__()
        self.loop = None
        self.turns = 0
        self.pause = None

    def select(self, timeout=None):
        events = super().select(0)
        self.turns += 1
        waits = not events and timeout != 0
        if waits or self.turns >= _MOST_TURNS:
            self.pause = timeout if waits else 0
            self.loop.stop()
        return events


class _Loop(asyncio.SelectorEventLoop):

    def call_soon(self, callback, *args, context=None):
        if self.is_running():
            return super().call_soon(callback, *args, context=context)
        # An event handler has something for a coroutine, so the launcher has to learn that a step is due.
        return self.call_soon_threadsafe(callback, *args, context=context)


# In a Python program of the user's they run on the program's own loop.
_of_program = hasattr(_launch_engine, 'IS_PROGRAM')

_selector = None
_tasks = {}  # each task with the object that made its coroutine
_background = set()  # tasks that do not keep the launch going


def loop():
    """The loop of all coroutines."""
    global _selector
    if _of_program:
        return _launch_engine.loop()
    if _selector is None:
        _selector = _Selector()
        _selector.loop = _Loop(_selector)
        asyncio.set_event_loop(_selector.loop)
    return _selector.loop


def start(coroutine, owner, background=False):
    """Runs it. A launch ends without the end of those in the background, which are cancelled like the others."""
    task = loop().create_task(coroutine)
    _tasks[task] = owner
    if _of_program:
        task.add_done_callback(lambda _task: _launch_engine.wish_for_a_step())
    if background:
        _background.add(task)


def leave_background():
    """From the next step on, the launch waits for the coroutine that calls this."""
    _background.discard(asyncio.current_task())


class Awaited:
    """Something that is waited for beside the processes."""

    def __init__(self, future):
        self._future = future

    def describe(self):
        return 'a future'

    def _start(self):
        start(self._wait(), self)

    async def _wait(self):
        try:
            await asyncio.wrap_future(self._future) if not asyncio.isfuture(self._future) else await self._future
        except asyncio.CancelledError:
            pass


def step():
    """
    (coroutines left, others left in the background, descriptor to wait for, seconds to wait or None).

    Raises what a coroutine raised.
    """
    if not _of_program:
        _selector.turns = 0
        loop().run_forever()
    for task in [task for task in _tasks if task.done()]:
        del _tasks[task]
        _background.discard(task)
        if not task.cancelled() and task.exception() is not None:
            raise task.exception()
    descriptor, pause = (_selector.fileno(), _selector.pause) if _selector is not None else (-1, None)
    return len(_tasks) - len(_background), len(_background), descriptor, pause


def cancel():
    for task in _tasks:
        task.cancel()


def forget():
    """Cancels what is left at the end of a launch, so that another one can begin."""
    cancel()
    _tasks.clear()
    _background.clear()
