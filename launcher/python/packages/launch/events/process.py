"""Events of processes."""

from launch import _names

_names.finish(__name__)
