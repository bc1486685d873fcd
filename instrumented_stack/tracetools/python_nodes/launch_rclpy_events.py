# SPDX-License-Identifier: Apache-2.0
"""Gives the callbacks of rclpy the events that rclcpp has. Changes classes of rclpy when a program imports them."""

import functools
import inspect
import sys

import _launch_rclpy_events as events


def symbol_of(callback):
    """The name of a callback, as `module.Class.method`; without the module in a program's own file."""
    while isinstance(callback, functools.partial):
        callback = callback.func
    name = getattr(callback, '__qualname__', None) or type(callback).__qualname__
    module = getattr(callback, '__module__', None)
    return name if module in (None, '__main__') else module + '.' + name


class _Steps:
    """A coroutine. Each part that runs without a pause is an execution of the callback."""

    def __init__(self, coroutine, number):
        self.coroutine = coroutine
        self.number = number

    def __await__(self):
        step, value = self.coroutine.send, None
        while True:
            events.callback_start(self.number)
            try:
                pending = step(value)
            except StopIteration as done:
                return done.value
            finally:
                events.callback_end(self.number)
            try:
                value = yield pending
                step = self.coroutine.send
            except GeneratorExit:
                self.coroutine.close()
                raise
            except BaseException as error:
                step, value = self.coroutine.throw, error


def traced(callback):
    """The callback with an event before and one after it, also after an exception. Returns it, and its number."""
    number = 0
    start, end = events.callback_start, events.callback_end
    if inspect.iscoroutinefunction(callback):
        @functools.wraps(callback)
        async def run(*arguments, **named):
            return await _Steps(callback(*arguments, **named), number)
    else:
        @functools.wraps(callback)
        def run(*arguments, **named):
            start(number)
            try:
                return callback(*arguments, **named)
            finally:
                end(number)
    number = id(run)
    return run, number


def _with_traced_callback(owner, tell):
    """Changes the constructor of a class, so that its argument `callback` is traced."""
    original = owner.__init__
    names = list(inspect.signature(original).parameters)
    place = names.index('callback') - 1  # without self

    @functools.wraps(original)
    def construct(self, *arguments, **named):
        number, symbol = None, ''
        try:
            callback = named['callback'] if 'callback' in named else arguments[place]
            if callable(callback) and events.find():
                symbol = symbol_of(callback)
                run, number = traced(callback)
                if 'callback' in named:
                    named['callback'] = run
                else:
                    arguments = (*arguments[:place], run, *arguments[place + 1:])
        except Exception:
            number = None
        original(self, *arguments, **named)
        if number is not None:
            try:
                tell(self, number)
                events.callback_register(number, symbol)
            except Exception:
                pass

    owner.__init__ = construct


def _subscription(self, number):
    events.subscription_init(self.handle.pointer, id(self))
    events.subscription_callback_added(id(self), number)


def _service(self, number):
    events.service_callback_added(self.handle.pointer, number)


def _timer(self, number):
    events.timer_callback_added(self.handle.pointer, number)


def _with_linked_timers(node):
    original = node.create_timer

    @functools.wraps(original)
    def create_timer(self, *arguments, **named):
        timer = original(self, *arguments, **named)
        try:
            if events.find():
                events.timer_link_node(timer.handle.pointer, self.handle.pointer)
        except Exception:
            pass
        return timer

    node.create_timer = create_timer


_CHANGES = {
    'rclpy.subscription': lambda module: _with_traced_callback(module.Subscription, _subscription),
    'rclpy.service': lambda module: _with_traced_callback(module.Service, _service),
    'rclpy.timer': lambda module: _with_traced_callback(module.Timer, _timer),
    'rclpy.node': lambda module: _with_linked_timers(module.Node),
}


class _Finder:
    """Finds the modules of rclpy as Python does, and changes each after its code has run."""

    @staticmethod
    def find_spec(name, path=None, target=None):
        change = _CHANGES.get(name)
        if change is None:
            return None
        for finder in sys.meta_path:
            find = getattr(finder, 'find_spec', None)
            spec = None if finder is _Finder or find is None else find(name, path, target)
            if spec is not None:
                break
        else:
            return None
        execute = getattr(spec.loader, 'exec_module', None)
        if execute is not None:
            def exec_module(module):
                execute(module)
                try:
                    change(module)
                except Exception:  # another shape than is known: it stays as it is
                    pass
            try:
                spec.loader.exec_module = exec_module
            except AttributeError:
                pass
        return spec


def install():
    """Changes what the program imports of rclpy from now on."""
    if _Finder not in sys.meta_path:
        sys.meta_path.insert(0, _Finder)
