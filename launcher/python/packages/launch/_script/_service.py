# SPDX-License-Identifier: Apache-2.0
"""LaunchService of a Python program."""

import asyncio
import os
import signal
import sys
import threading
import warnings

import _launch_engine
from launch import _coroutines, _dispatch, _environment
from launch._entities import entities, entity
from launch._places import caller
from launch._script import _calls, _link, _program
from launch.actions import _processes
from launch.event_handlers import OnProcessExit, OnProcessStart
from launch.events import IncludeLaunchDescription, Shutdown
from launch.events.process import command_line
from launch.launch_context import LaunchContext

_SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGQUIT)


class ServiceContext(LaunchContext):
    """The context of a LaunchService. What it is asked for before the launch runs is done at its begin."""

    def __init__(self, argv, noninteractive):
        super().__init__(argv=argv, noninteractive=noninteractive)
        self._waiting = []
        self._link = None
        self._is_shutdown = False
        self._running = set()  # process ids

    def _do(self, function):
        if self._link is None:
            self._waiting.append(function)
        else:
            self._link.run(function)

    def _begin(self, link):
        """Called while the launcher visits the beginning of the launch."""
        for name, value in self.launch_configurations.items():
            _launch_engine.set(False, str(name), str(value))
        self.launch_configurations = _environment.configurations
        self._link = link
        # Events tell the actions what became of their processes, whoever else has a handler.
        for handler in (OnProcessStart(on_start=self._on_start), OnProcessExit(on_exit=self._on_exit)):
            handler._made_at = None
            _launch_engine.visit(handler._all_tags(None, []))
        waiting, self._waiting = self._waiting, []
        for function in waiting:
            function()

    def _on_start(self, event, _context):
        self._running.add(event.pid)
        words = command_line(event.pid) if event.action is not None else None
        if words:
            event.action._final_cmd = words
            event.action.process_details['cmd'] = words

    def _on_exit(self, event, _context):
        self._running.discard(event.pid)

    def _end(self):
        self._running.clear()
        self._link = None
        self.launch_configurations = {}

    @property
    def is_shutdown(self):
        return self._is_shutdown

    @property
    def asyncio_loop(self):
        return self._link and self._link.loop

    def emit_event_sync(self, event):
        place = caller()
        if isinstance(event, IncludeLaunchDescription):
            self._do(lambda: _launch_engine.visit(entities(event.launch_description)))
        else:
            self._do(lambda: self._emit(event, place))

    def register_event_handler(self, event_handler, append=False):
        self._do(lambda: super(ServiceContext, self).register_event_handler(event_handler, append))

    def unregister_event_handler(self, event_handler):
        self._do(lambda: super(ServiceContext, self).unregister_event_handler(event_handler))

    def add_completion_future(self, completion_future):
        self._do(lambda: super(ServiceContext, self).add_completion_future(completion_future))


class _Step(_dispatch._Step):
    """A function that the launcher calls once, while it visits."""

    def __init__(self, function):
        self._function = function

    def _do(self, _context):
        self._function()
        return []


class _Presence:
    """Stands for the script among the coroutines of the launch."""

    def describe(self):
        return 'the script'

    def _start(self):
        pass


def _file_of_caller():
    frame = sys._getframe(2)
    return os.path.abspath(frame.f_code.co_filename) if frame.f_code.co_filename[:1] != '<' else ''


# More than any command line has: an endless iterator must not fill the memory.
_MOST_WORDS = 100_000


def _words(argv):
    words = []
    for word in argv or ():
        if not isinstance(word, str):
            raise TypeError(f'argv holds texts, got {type(word).__name__}')
        if len(words) == _MOST_WORDS:
            raise ValueError(f'argv holds more than {_MOST_WORDS} texts')
        words.append(word)
    return words


class LaunchService:
    """
    Runs launch descriptions from a Python program, as ROS 2's class of this name does.

    emit_event(), include_launch_description() and shutdown() may be called by any thread. One LaunchService runs at a time
    in a process.
    """

    def __init__(self, *, argv=None, noninteractive=False, debug=False):
        self._file = _file_of_caller()
        self._debug = debug
        self._context = ServiceContext(_words(argv), noninteractive)
        self._link = None
        self._process = None
        self._task = None
        self._is_shutting_down = False

    @property
    def context(self):
        return self._context

    @property
    def event_loop(self):
        """The asyncio loop while the launch runs, else None."""
        return self._link and self._link.loop

    @property
    def task(self):
        """The task of run_async()."""
        return self._task

    def include_launch_description(self, launch_description):
        """Visits the description: at once while the launch runs, else at its begin."""
        self.emit_event(IncludeLaunchDescription(launch_description))

    def emit_event(self, event):
        """Emits the event: at once while the launch runs, else at its begin."""
        self._context.emit_event_sync(event)

    def shutdown(self, force_sync=False):
        """
        Ends the launch. Does nothing when it does not run.

        In the thread of the loop the result can be awaited, unless `force_sync`; the end has begun already then.
        """
        link = self._link
        if link is None:
            return None
        if not self._is_shutting_down:
            self._is_shutting_down = True
            try:
                self.emit_event(Shutdown(reason='LaunchService.shutdown() called'))
            except _link.LaunchHasEnded:
                pass
        if force_sync or not link.is_of_this_thread():
            return None
        done = link.loop.create_future()
        done.set_result(None)
        return done

    def run(self, *, shutdown_when_idle=True):
        """Runs the launch to its end. The exit code: 0, or what the launcher ended with."""
        with warnings.catch_warnings():
            warnings.simplefilter('ignore', DeprecationWarning)
            try:
                loop = asyncio.get_event_loop()
            except RuntimeError:
                loop = None
        is_own = loop is None or loop.is_closed()
        if is_own:
            loop = asyncio.new_event_loop()
            asyncio.set_event_loop(loop)
        try:
            return loop.run_until_complete(self.run_async(shutdown_when_idle=shutdown_when_idle))
        finally:
            if is_own:
                asyncio.set_event_loop(None)
                loop.close()

    async def run_async(self, *, shutdown_when_idle=True):
        """The same on the asyncio loop that runs already."""
        if _link.current is not None:
            raise RuntimeError('a LaunchService runs in this process already; one at a time can')
        loop = asyncio.get_running_loop()
        link = self._prepare(loop, shutdown_when_idle)
        signals = _Signals(loop, self._on_signal)
        try:
            sys.stdout.flush()
            self._process = _program.start(self._file, link.descriptors(), self._debug)
            link.leave_to_launcher()
            code = await self._end_of_process(link.ended(self._process))
        finally:
            signals.restore()
            self._clean_up(link)
        return code if code >= 0 else 128 - code

    def _prepare(self, loop, shutdown_when_idle):
        calls = _calls.Calls(self._begin, lambda: not shutdown_when_idle and not self._context.is_shutdown,
                             self._on_shutdown)
        link = self._link = _link.current = _link.Link(loop, calls)
        calls.objects = link.objects
        self._task = asyncio.current_task()
        self._is_shutting_down = False
        self._context._is_shutdown = False
        _processes.forget()
        LaunchContext._launch = self._context
        return link

    def _begin(self):
        return [entity('', None, [], obj=_Step(lambda: self._context._begin(self._link))),
                entity('', None, [], obj=_Step(lambda: _launch_engine.run_coroutine(_Presence())))]

    def _on_shutdown(self):
        self._is_shutting_down = True
        self._context._is_shutdown = True

    def _on_signal(self, number):
        if self._process is not None:
            self._process.send_signal(number)

    async def _end_of_process(self, ended):
        try:
            return await asyncio.shield(ended)
        except asyncio.CancelledError:
            # What was launched ends first. A task that is cancelled again does not end earlier.
            self._process.send_signal(signal.SIGINT)
            while True:
                try:
                    await asyncio.shield(ended)
                    return 1
                except asyncio.CancelledError:
                    continue

    def _clean_up(self, link):
        link.close()
        if self._process is not None and self._process.poll() is None:
            self._process.send_signal(signal.SIGTERM)
            self._process.wait()
        self._process = None
        self._link = _link.current = LaunchContext._launch = None
        self._context._end()
        _coroutines.forget()
        _dispatch.forget()


class _Signals:
    """Passes signals of the process on while the launch runs. Only the main thread of Python can."""

    def __init__(self, loop, handle):
        self._loop = loop
        self._before = {}
        if threading.current_thread() is threading.main_thread():
            for number in _SIGNALS:
                self._before[number] = signal.getsignal(number)
                loop.add_signal_handler(number, handle, number)

    def restore(self):
        for number, handler in self._before.items():
            self._loop.remove_signal_handler(number)
            if handler is not None:
                signal.signal(number, handler)
