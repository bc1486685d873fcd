# SPDX-License-Identifier: Apache-2.0
"""What the launcher calls in the user's process."""

import importlib

from launch import _coroutines, _load
from launch._script import _values
from launch._values import WrongKind


def _evaluate(expression, modules):
    """str() of a Python expression; the names of "math" can be used without the module."""
    names = {'__builtins__': importlib.import_module('builtins')}
    for name in filter(None, map(str.strip, modules.split(','))):
        module = importlib.import_module(name)
        names[name.partition('.')[0]] = importlib.import_module(name.partition('.')[0])
        if name == 'math':
            names.update((key, value) for key, value in vars(module).items() if key[0] != '_')
    return str(eval(expression, names))


class Calls:
    """The calls for one launch."""

    def __init__(self, begin, is_kept, on_shutdown):
        """
        `begin` gives the entities that the launch begins with. `is_kept()`: whether the launch goes on although it is
        idle. `on_shutdown` is called when it begins to end.
        """
        self._begin = begin
        self._is_kept = is_kept
        self._on_shutdown = on_shutdown
        self.objects = None

    def __call__(self, call):
        return getattr(self, '_' + call['call'])(call)

    def _load(self, call):
        begin, self._begin = self._begin, None
        found = begin() if begin is not None else _load.load_file(call['path'], call['text'])
        return _values.entities(found, self.objects)

    def _evaluate(self, call):
        return _evaluate(call['expression'], call['modules'])

    def _perform(self, call):
        value = self.objects[call['object']]._perform()
        if not isinstance(value, str):
            raise WrongKind(f'a text is needed, got {type(value).__name__}')
        return _values._str(value)

    def _describe(self, call):
        obj = self.objects[call['object']]
        try:
            return str(obj.describe())
        except Exception:
            return f'{type(obj).__name__}()'

    def _function(self, call):
        return self.objects[call['object']]._calls()

    def _execute(self, call):
        return _values.entities(self.objects[call['object']]._execute(), self.objects)

    def _start(self, call):
        self.objects[call['object']]._start()

    def _make_action(self, call):
        from launch.frontend import _extensions
        made = _extensions.make_action(_values.element(call['element']))
        return None if made is None else _values.entities(made, self.objects)

    def _make_substitution(self, call):
        from launch.frontend import _extensions
        made = _extensions.make_substitution(call['name'], call['arguments'], tuple(call['place']))
        return None if made is None else _values.text(made, self.objects)

    def _exposed_names(self, call):
        from launch.frontend import _extensions
        return list(_extensions.exposed(call['of_actions']))

    def _step(self, _call):
        running, background, *_ = _coroutines.step()
        # The connection itself counts as a coroutine, which has the launcher look at it.
        return (running + 1, background) if self._is_kept() else (running, background + 1)

    def _cancel(self, _call):
        self._on_shutdown()
        _coroutines.cancel()
