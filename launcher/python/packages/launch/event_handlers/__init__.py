# SPDX-License-Identifier: Apache-2.0
"""
Handlers of what happens to processes and to the launch.

A handler has a list of actions, or a function of the event and the context that returns actions.
"""

from launch import _names
from launch.event_handlers._handlers import (
    OnActionEventBase, OnExecutionComplete, OnIncludeLaunchDescription, OnProcessExit, OnProcessIO, OnProcessStart,
    OnShutdown)


def event_named(name):
    """A matcher of the events with this name."""
    return lambda event: event.name == name


_names.one_class_modules(__name__)
_names.same_module(__name__, __name__ + '.on_process_io', __name__ + '.event_named')
