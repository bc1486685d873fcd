"""Event: something that happens while the launch runs."""

from launch import _names


class Event:
    name = 'launch.Event'


_names.finish(__name__)
