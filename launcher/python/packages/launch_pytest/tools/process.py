# SPDX-License-Identifier: Apache-2.0
"""
Waits for the start, the end and the output of a process.

Each function takes the context of the launch, the action of the process and `timeout` seconds; None waits without a
limit. Async tests call those without `_sync`; other tests, which run on a thread beside the loop of the launch, call
those with it. Output is that of get_stdout() and get_stderr(), so the action needs cached_output=True.
"""

import asyncio
import contextlib
import threading
import time

from launch.event_handlers import OnProcessExit, OnProcessIO, OnProcessStart

__unittest = True  # tracebacks of tests end at the test


@contextlib.contextmanager
def register_event_handler(context, event_handler):
    """The handler is registered in the block."""
    context.register_event_handler(event_handler, append=True)
    try:
        yield
    finally:
        # When the launch has ended meanwhile, it has no handlers any more.
        with contextlib.suppress(RuntimeError):
            context.unregister_event_handler(event_handler)


def _of_stdout(action, call):
    return OnProcessIO(target_action=action, on_stdout=lambda _event: call())


def _of_stderr(action, call):
    return OnProcessIO(target_action=action, on_stderr=lambda _event: call())


def _of_start(action, call):
    return OnProcessStart(target_action=action, on_start=lambda _event, _context: call())


def _of_exit(action, call):
    return OnProcessExit(target_action=action, on_exit=lambda _event, _context: call())


async def _wait(context, handler, action, holds, timeout):
    """Whether `holds()` within the time. It is asked at the begin and after each event of the handler."""
    event = asyncio.Event()

    async def until_it_holds():
        while not holds():
            await event.wait()
            event.clear()

    if holds():
        return True
    with register_event_handler(context, handler(action, event.set)):
        try:
            await asyncio.wait_for(until_it_holds(), timeout)
        except asyncio.TimeoutError:
            return holds()
    return True


def _wait_sync(context, handler, action, holds, timeout):
    loop = context.asyncio_loop
    try:
        here = asyncio.get_running_loop()
    except RuntimeError:
        here = None
    if here is not None and here is loop:
        raise RuntimeError('an async test must await the function without _sync: this one would block the launch')
    if holds():
        return True
    event = threading.Event()
    end = None if timeout is None else time.monotonic() + timeout
    with register_event_handler(context, handler(action, event.set)):
        while not holds():
            left = None if end is None else end - time.monotonic()
            if left is not None and left <= 0 or not event.wait(left):
                return holds()
            event.clear()
    return True


def _does_not_raise(validate, output):
    def holds():
        try:
            validate(output())
        except AssertionError:
            return False
        return True
    return holds


async def _assert(context, handler, action, validate, output, timeout):
    if not await _wait(context, handler, action, _does_not_raise(validate, output), timeout):
        validate(output())


def _assert_sync(context, handler, action, validate, output, timeout):
    if not _wait_sync(context, handler, action, _does_not_raise(validate, output), timeout):
        validate(output())


async def wait_for_output(launch_context, execute_process_action, validate_output, timeout=None):
    """Whether `validate_output(stdout)` is true within the time."""
    return await _wait(launch_context, _of_stdout, execute_process_action,
                       lambda: validate_output(execute_process_action.get_stdout()), timeout)


async def assert_output(launch_context, execute_process_action, validate_output, timeout=None):
    """Fails with the AssertionError of `validate_output(stdout)` unless it raises none within the time."""
    await _assert(launch_context, _of_stdout, execute_process_action, validate_output, execute_process_action.get_stdout, timeout)


def wait_for_output_sync(launch_context, execute_process_action, validate_output, timeout=None):
    return _wait_sync(launch_context, _of_stdout, execute_process_action,
                      lambda: validate_output(execute_process_action.get_stdout()), timeout)


def assert_output_sync(launch_context, execute_process_action, validate_output, timeout=None):
    _assert_sync(launch_context, _of_stdout, execute_process_action, validate_output, execute_process_action.get_stdout, timeout)


async def wait_for_stderr(launch_context, execute_process_action, validate_output, timeout=None):
    return await _wait(launch_context, _of_stderr, execute_process_action,
                       lambda: validate_output(execute_process_action.get_stderr()), timeout)


async def assert_stderr(launch_context, execute_process_action, validate_output, timeout=None):
    await _assert(launch_context, _of_stderr, execute_process_action, validate_output, execute_process_action.get_stderr, timeout)


def wait_for_stderr_sync(launch_context, execute_process_action, validate_output, timeout=None):
    return _wait_sync(launch_context, _of_stderr, execute_process_action,
                      lambda: validate_output(execute_process_action.get_stderr()), timeout)


def assert_stderr_sync(launch_context, execute_process_action, validate_output, timeout=None):
    _assert_sync(launch_context, _of_stderr, execute_process_action, validate_output, execute_process_action.get_stderr, timeout)


def _has_started(action):
    return lambda: action.process_details is not None


def _has_ended(action):
    return lambda: action.return_code is not None


async def wait_for_start(launch_context, execute_process_action, timeout=None):
    """Whether the process starts within the time, or has started before."""
    return await _wait(launch_context, _of_start, execute_process_action, _has_started(execute_process_action), timeout)


def wait_for_start_sync(launch_context, execute_process_action, timeout=None):
    return _wait_sync(launch_context, _of_start, execute_process_action, _has_started(execute_process_action), timeout)


async def wait_for_exit(launch_context, execute_process_action, timeout=None):
    """Whether the process ends within the time, or has ended before."""
    return await _wait(launch_context, _of_exit, execute_process_action, _has_ended(execute_process_action), timeout)


def wait_for_exit_sync(launch_context, execute_process_action, timeout=None):
    return _wait_sync(launch_context, _of_exit, execute_process_action, _has_ended(execute_process_action), timeout)
