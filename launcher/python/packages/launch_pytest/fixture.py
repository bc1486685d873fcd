# SPDX-License-Identifier: Apache-2.0
"""The decorator of functions that give a launch description, and the fixtures of the launch itself."""

import asyncio
import sys

import launch
import pytest

_SCOPES = ('function', 'class', 'module', 'package', 'session')
_OPTIONS = '_launch_pytest_options'
_OWN_SCOPE = '_launch_pytest_scope'


class Options:
    """What a launch fixture was declared with."""

    def __init__(self, name, scope, shutdown_when_idle, auto_shutdown):
        self.name = name
        self.scope = scope
        self.shutdown_when_idle = shutdown_when_idle
        self.auto_shutdown = auto_shutdown


def options_of(given):
    """The options of a launch fixture, or of its function; None for anything else."""
    return getattr(given, _OPTIONS, None)


def finish(launch_service, when, auto_shutdown=True):
    """Ends the launch, or waits for its end. Fails if the launch had an error."""
    if auto_shutdown:
        launch_service.shutdown(force_sync=True)
    task = launch_service.task
    if task is None or task.get_loop().is_closed():
        return
    code = task.get_loop().run_until_complete(task)
    assert code == 0, f'{when}: the launch ended with the return code {code}'


def _make_event_loop():
    loop = asyncio.new_event_loop()
    asyncio.set_event_loop(loop)
    yield loop
    tasks = asyncio.all_tasks(loop)
    for task in tasks:
        task.cancel()
    loop.run_until_complete(asyncio.gather(*tasks, return_exceptions=True))
    loop.run_until_complete(loop.shutdown_default_executor())
    asyncio.set_event_loop(None)
    loop.close()


def _make_launch_service(event_loop):
    service = launch.LaunchService()
    yield service
    finish(service, 'at the end of the fixture launch_service')


def _make_launch_context(launch_service):
    return launch_service.context


_MAKERS = {'event_loop': _make_event_loop, 'launch_service': _make_launch_service,
           'launch_context': _make_launch_context}


def fixture_of_launch(name, scope):
    """The fixture `event_loop`, `launch_service` or `launch_context` with a scope."""
    maker = _MAKERS[name]

    if name == 'event_loop':
        def made():
            yield from maker()
    elif name == 'launch_service':
        def made(event_loop):
            yield from maker(event_loop)
    else:
        def made(launch_service):
            return maker(launch_service)

    made.__name__ = name
    made.__doc__ = f'The {name} of the launch that is tested.'
    result = pytest.fixture(scope=scope)(made)
    setattr(result, _OWN_SCOPE, scope)
    return result


def _widen(names, scope):
    # A launch fixture of a wider scope needs the launch in that scope. What a file has defined itself stays.
    for name in _MAKERS:
        of_file = names.get(name)
        if of_file is None or _SCOPES.index(getattr(of_file, _OWN_SCOPE, 'session')) < _SCOPES.index(scope):
            names[name] = fixture_of_launch(name, scope)


def fixture(decorated=None, *args, shutdown_when_idle=True, auto_shutdown=True, **kwargs):
    """
    Declares a function that returns a LaunchDescription, or a sequence that begins with one.

    `shutdown_when_idle`: the launch ends when nothing is left to run. `auto_shutdown`: it is ended after the tests;
    otherwise it must end by itself. All other arguments are those of pytest.fixture().
    """
    scope = kwargs.get('scope', 'function')
    if scope != 'function':
        if scope not in _SCOPES:
            raise ValueError(f'scope must be one of {", ".join(_SCOPES)}, got {scope!r}')
        _widen(sys._getframe(1).f_globals, scope)

    def decorate(function):
        options = Options(kwargs.get('name') or function.__name__, scope, shutdown_when_idle, auto_shutdown)
        setattr(function, _OPTIONS, options)
        made = pytest.fixture(*args, **kwargs)(function)
        setattr(made, _OPTIONS, options)
        return made

    return decorate if decorated is None else decorate(decorated)
