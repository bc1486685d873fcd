"""Handlers of what happens to processes and to the launch."""

from launch import _names

_names.finish(__name__, one_class_modules=True)
