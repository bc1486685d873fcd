# SPDX-License-Identifier: Apache-2.0
"""
What the packages ask of the launcher, in a Python program of the user's: over the connection of its LaunchService.

In the launcher's own Python a module of this name is built in, which comes before this file.
"""

IS_PROGRAM = True  # before the import: the packages ask for it while they are imported

from launch._script import _link, _values  # noqa: E402


def has_launch():
    """Whether a LaunchService runs in this program."""
    return _link.current is not None


def is_running():
    """Whether this thread is the one that carries the launch out."""
    return _link.of_this_thread() is not None


def loop():
    """The asyncio loop of the program, on which coroutines of the launch run; None when no launch runs."""
    return _link.current and _link.current.loop


def wish_for_a_step():
    """Has the launcher look for what the coroutines have done."""
    if _link.current is not None:
        _link.current.wish()


def _ask(what, **arguments):
    if _link.current is None:
        raise RuntimeError('no launch is running here')
    return _link.current.ask({'host': what, **arguments})


def perform(value, configurations=None):
    if _link.current is None:
        raise RuntimeError('a substitution has a value only while a LaunchService runs')
    own = None if configurations is None else {str(name): str(content) for name, content in configurations.items()}
    return _ask('perform', text=_values.text(value, _link.current.objects), configurations=own)


def get(environment, name):
    return _ask('get', environment=environment, name=name)


def set(environment, name, value):  # noqa: A001  the launcher's name
    _ask('set', environment=environment, name=name, value=value)


def erase(environment, name):
    _ask('erase', environment=environment, name=name)


def names(environment):
    return _ask('names', environment=environment)


def log_directory():
    return _ask('log_directory')


def message(level, logger, text):
    _ask('message', level=level, logger=logger, text=text)


def visit(entities):
    if _link.current is None:
        raise RuntimeError('no launch is running here')
    _ask('visit', entities=_values.entities(entities, _link.current.objects))


def run_coroutine(owner):
    if _link.current is None:
        raise RuntimeError('no launch is running here')
    _ask('run_coroutine', object=_link.current.objects.number(owner))


def push(environment):
    _ask('push', environment=environment)


def pop(environment):
    _ask('pop', environment=environment)
