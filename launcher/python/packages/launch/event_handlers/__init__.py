"""Handlers of what happens to processes and to the launch."""

from launch import _names

_names.one_class_modules(__name__)
