# SPDX-License-Identifier: Apache-2.0
"""The plugin of pytest: runs what launch fixtures give, and tests that are marked with pytest.mark.launch."""

import asyncio
import functools
import inspect
from collections.abc import Sequence

import launch
import pytest
from launch_pytest.actions import ReadyToTest
from launch_pytest.fixture import finish, fixture_of_launch, options_of
from launch_testing._time_to_end import LOOK, TimeToEnd

__unittest = True  # tracebacks of tests end at the test

event_loop = fixture_of_launch('event_loop', 'function')
launch_service = fixture_of_launch('launch_service', 'function')
launch_context = fixture_of_launch('launch_context', 'function')

_SHUTDOWN_PART = '[shutdown_test]'
_NO_FIXTURE = '"fixture" keyword argument is required in a pytest.mark.launch() decorator'


class LaunchTestWarning(pytest.PytestWarning):
    """A mark that can't be right."""


def pytest_configure(config):
    config.addinivalue_line('markers', 'launch(fixture, shutdown=False): a test of the launch that the fixture describes; '
                                       'with shutdown=True it runs when the launch has ended')


# Launch fixtures.

def _ready_actions(entities):
    for each in entities:
        if isinstance(each, ReadyToTest):
            yield each
        yield from _ready_actions(each.describe_sub_entities())
        for _, conditional in each.describe_conditional_sub_entities():
            yield from _ready_actions(conditional)


def _ready_action(description):
    found = list(_ready_actions(description.entities))
    if len(found) > 1:
        raise RuntimeError('launch_pytest fixtures must return a LaunchDescription containing only one ReadyToTest action')
    if not found:
        found.append(ReadyToTest())
        description.entities.append(found[0])
    return found[0]


@pytest.hookimpl(hookwrapper=True, tryfirst=True)
def pytest_fixture_setup(fixturedef, request):
    options = options_of(fixturedef.func)
    if options is None:
        yield
        return
    service = request.getfixturevalue('launch_service')
    loop = request.getfixturevalue('event_loop')
    outcome = yield
    try:
        _begin(fixturedef, options, service, loop, outcome.get_result())
    except BaseException as error:
        # What such a hook raises is a warning as well with newer versions of pluggy.
        if not hasattr(outcome, 'force_exception'):
            raise
        outcome.force_exception(error)


def _begin(fixturedef, options, service, loop, result):
    description = result[0] if isinstance(result, Sequence) and result else result
    if not isinstance(description, launch.LaunchDescription):
        pytest.fail(f"launch_pytest fixture '{options.name}': the return value must be either a launch description or a "
                    f'sequence whose first item is one, got {type(result).__name__}', pytrace=False)
    ready = asyncio.Event()
    _ready_action(description)._add_callback(ready.set)
    service.include_launch_description(description)
    fixturedef.addfinalizer(functools.partial(finish, service, f"launch_pytest fixture '{options.name}'",
                                              options.auto_shutdown))
    loop.run_until_complete(_until_ready(loop, service, ready, options))


async def _until_ready(loop, service, ready, options):
    run = loop.create_task(service.run_async(shutdown_when_idle=options.shutdown_when_idle))
    waiting = loop.create_task(ready.wait())
    await asyncio.wait({run, waiting}, return_when=asyncio.FIRST_COMPLETED)
    if not ready.is_set():
        waiting.cancel()
        code = await run
        pytest.fail(f"launch_pytest fixture '{options.name}': the launch ended before ReadyToTest was visited, with the "
                    f'return code {code}', pytrace=False)


# Tests.

def _mark_of(collector, function):
    own = [mark for mark in getattr(function, 'pytestmark', []) if mark.name == 'launch']
    return own[-1] if own else collector.get_closest_marker('launch')


def _has_two_parts(function):
    return inspect.isgeneratorfunction(function) or inspect.isasyncgenfunction(function)


class _Part:
    """How an item is run: the options of its fixture, whether after the end, and the item of the other part."""

    def __init__(self, options, after):
        self.options = options
        self.after = after
        self.second = None  # the item that goes on with the generator
        self.generator = None


def _part_of(item):
    return getattr(item, '_launch_pytest_part', None)


@pytest.hookimpl(tryfirst=True)
def pytest_pycollect_makeitem(collector, name, obj):
    if not (inspect.isfunction(obj) and collector.funcnamefilter(name)):
        return None
    mark = _mark_of(collector, obj)
    if mark is None:
        return None
    fixture = mark.kwargs.get('fixture')
    options = options_of(fixture)
    if options is None:
        reason = _NO_FIXTURE if fixture is None else (
            f'the fixture of pytest.mark.launch() of {name} is no fixture of launch_pytest')
        pytest.mark.skip(reason)(obj)
        items = list(collector._genfunctions(name, obj))
        items[0].warn(LaunchTestWarning(reason))
        return items
    pytest.mark.usefixtures(options.name, 'launch_service', 'event_loop')(obj)
    items = []
    for item in collector._genfunctions(name, obj):
        item._launch_pytest_part = _Part(options, mark.kwargs.get('shutdown', False))
        items.append(item)
    if _has_two_parts(obj) and options.scope != 'function':
        seconds = list(collector._genfunctions(name, obj))
        for first, second in zip(items, seconds):
            second._launch_pytest_part = _Part(options, True)
            second.name += _SHUTDOWN_PART
            second._nodeid += _SHUTDOWN_PART
            first._launch_pytest_part.second = second
        items += seconds
    return items


def _launch_of(item):
    """What items have in common that are tests of the same launch; None for those that have one of their own."""
    part = _part_of(item)
    if part is None or part.options.scope == 'function':
        return None
    holder = {'class': pytest.Class, 'module': pytest.Module}.get(part.options.scope)
    parameters = getattr(getattr(item, 'callspec', None), 'params', {}).get(part.options.name)
    return part.options, item.getparent(holder) if holder else None, repr(parameters)


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(items):
    """Of the tests of one launch, those after its end come last."""
    places = {}
    for index, item in enumerate(items):
        key = _launch_of(item)
        if key is not None:
            places.setdefault(key, []).append(index)
    for indices in places.values():
        ordered = sorted((items[index] for index in indices), key=lambda item: _part_of(item).after)
        for index, item in zip(indices, ordered):
            items[index] = item


@pytest.hookimpl(tryfirst=True)
def pytest_pyfunc_call(pyfuncitem):
    part = _part_of(pyfuncitem)
    if part is None:
        return None
    function = pyfuncitem.obj
    run = _Run(pyfuncitem, part)
    if not part.after:
        pyfuncitem.funcargs['launch_service']._has_active_tests = True
    if _has_two_parts(function):
        if part.after and part.second is None and not pyfuncitem.name.endswith(_SHUTDOWN_PART):
            pytest.fail('generator or async generator based launch test items cannot be marked with shutdown=True',
                        pytrace=False)
        run.generator_part()
    else:
        if part.after:
            run.end_of_launch()
        run.call(functools.partial(function, **run.arguments), inspect.iscoroutinefunction(function))
    return True


async def _let_end(service):
    """Without active tests the launch is ended at once. A process that ends by itself may do so first."""
    time_to_end = TimeToEnd()
    while not service.task.done():
        await asyncio.wait({service.task}, timeout=LOOK)
        if time_to_end.is_over(set(service.context._running)):
            return


class _Run:
    """The run of one test."""

    def __init__(self, item, part):
        self._item = item
        self._part = part
        self._loop = item.funcargs['event_loop']
        self.arguments = {name: item.funcargs[name] for name in item._fixtureinfo.argnames}

    def end_of_launch(self):
        service = self._item.funcargs['launch_service']
        if not getattr(service, '_has_active_tests', False) and service.task is not None:
            self._loop.run_until_complete(_let_end(service))
        finish(service, f'test {self._item.name}', self._part.options.auto_shutdown)

    def call(self, function, is_async):
        """Async functions run on the loop of the launch; others on a thread, while the loop runs."""
        if is_async:
            return self._loop.run_until_complete(function())
        return self._loop.run_until_complete(self._loop.run_in_executor(None, function))

    def generator_part(self):
        if self._item.name.endswith(_SHUTDOWN_PART):
            if self._part.generator is None:
                pytest.skip('shutdown test skipped because the test failed before')
            self._second(self._part.generator)
            return
        generator = self._item.obj(**self.arguments)
        self._next(generator)
        if self._part.second is None:
            self._second(generator)
        else:
            _part_of(self._part.second).generator = generator

    def _next(self, generator):
        """Whether the generator goes on. It must the first time."""
        ended = object()
        if inspect.isasyncgen(generator):
            async def step():
                return await anext(generator, ended)
            return self.call(step, True) is not ended
        return self.call(lambda: next(generator, ended), False) is not ended

    def _second(self, generator):
        self.end_of_launch()
        if self._next(generator):
            pytest.fail('launch tests using a generator function must stop iteration after yielding once', pytrace=False)
