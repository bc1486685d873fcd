# SPDX-License-Identifier: Apache-2.0
"""
Event handlers that decide themselves which events they handle, and the events of launch files.

The launcher tells of what happens to processes and of the shutdown; each of these handlers is then asked whether the
event is one for it, the newest handler first. An event that a launch file emits is handled after the traversal that has
emitted it.
"""

from launch._entities import entities, entity, told_at
from launch._places import Located, name_of_function

_handlers = []
_watches = False  # whether the launcher tells of events already


def is_of_file(function):
    """Whether the function is not one of these packages."""
    return name_of_function(function) is not None


class _Step(Located):
    """Something that the launcher calls while it visits."""

    def describe(self):
        return type(self).__name__.lower()

    def _calls(self):
        return None

    def _execute(self):
        from launch.launch_context import LaunchContext
        with told_at(self):
            return self._do(LaunchContext._of_launch())


class Registration(_Step):

    def __init__(self, handler):
        self._handler = handler

    def _do(self, context):
        return register(self._handler)


def register(handler, append=False):
    """Registers the handler; the entities by which the launcher tells of events, if it does not yet."""
    global _watches
    _handlers.insert(len(_handlers) if append else 0, handler)
    if _watches:
        return []
    _watches = True
    from launch.event_handlers import OnProcessExit, OnProcessIO, OnProcessStart, OnShutdown

    def handled_output(event):
        from launch.launch_context import LaunchContext
        return handled(event, LaunchContext._of_launch())

    watchers = [OnProcessStart(on_start=handled), OnProcessExit(on_exit=handled),
                OnProcessIO(on_stdout=handled_output, on_stderr=handled_output), OnShutdown(on_shutdown=handled)]
    for watcher in watchers:
        watcher._made_at = handler._made_at
    return [tag for watcher in watchers for tag in watcher._tags(handler._place(), [])]


def unregister(handler):
    """Whether the handler was one of these."""
    if handler not in _handlers:
        return False
    _handlers.remove(handler)
    return True


def forget():
    """Forgets all handlers at the end of a launch, so that another one can begin."""
    global _watches
    _handlers.clear()
    _emitted.clear()
    _watches = False


def would_handle(event):
    return any(handler.matches(event) for handler in _handlers)


def handled(event, context):
    """What the handlers of the event give, to be visited."""
    found = []
    for handler in list(_handlers):
        if handler in _handlers and handler.matches(event):
            result = handler.handle(event, context)
            if result is not None:
                found.append(result)
    return found


_emitted = []  # events that wait for the end of the traversal


class _Emission(_Step):
    """Notes the event."""

    def __init__(self, event):
        self._event = event

    def _do(self, context):
        _emitted.append(self._event)
        step = _Handling(self._event)
        step._made_at = None
        return [entity('timer', None, [('period', ('0',))], [entity('', None, [], obj=step)])]


class _Handling(_Step):
    """Handles the oldest event, however the launcher orders timers."""

    def __init__(self, event):
        self._event = event

    # A matcher is a function of the launch file, so a plan only names the event.
    def _calls(self):
        return f'the handlers of {type(self._event).__name__}' if _handlers else None

    def _do(self, context):
        event = _emitted.pop(0)
        outer = dict(context._locals)
        found = entities(handled(event, context), self._place())
        restoration = _Restoration(outer)
        restoration._made_at = None
        return [*found, entity('', None, [], obj=restoration)]


class _Restoration(_Step):
    """Ends what `context.locals` shows of an event."""

    def __init__(self, locals_):
        self._locals = locals_

    def _do(self, context):
        context._locals = self._locals
        return []


def emission(event, place, when=()):
    """The entity that emits an event of a launch file. Its handlers are visited after the present traversal."""
    step = _Emission(event)
    step._made_at = None
    return entity('', place, when, obj=step)


class _IfWanted(_Step):
    """Tells of an event that most launches have no handler for."""

    def __init__(self, event):
        self._event = event

    # As for the handling itself: a plan calls no matcher.
    def _calls(self):
        return f'the handlers of {type(self._event).__name__}' if _handlers else None

    def _do(self, context):
        return [emission(self._event, None)] if would_handle(self._event) else []


def told_if_wanted(event, place):
    step = _IfWanted(event)
    step._made_at = None
    return entity('', place, [], obj=step)
