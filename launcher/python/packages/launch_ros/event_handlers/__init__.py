"""Handlers of what happens to ROS nodes."""

from launch import _names
from launch._values import LaunchFileError
from launch.event_handler import BaseEventHandler


class OnStateTransition(BaseEventHandler):

    def __init__(self, **_kwargs):
        raise LaunchFileError('this launcher has no event for the states of a node',
                              'autostart=True configures and activates it; LifecycleTransition asks for transitions in a row')


_names.one_class_modules(__name__)
