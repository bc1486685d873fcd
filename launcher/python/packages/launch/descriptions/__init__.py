# SPDX-License-Identifier: Apache-2.0
"""Descriptions of programs."""

from launch import _names
from launch._places import Located
from launch._values import words


class Executable(Located):
    """A program with its arguments and its environment."""

    _OPTIONS = ('prefix', 'name', 'cwd', 'env', 'additional_env')

    def __init__(self, *, cmd, prefix=None, name=None, cwd=None, env=None, additional_env=None, arguments=None):
        self._command = words(cmd, 'cmd') + words(arguments or [], 'arguments')
        self._options = {'prefix': prefix, 'name': name, 'cwd': cwd, 'env': env, 'additional_env': additional_env}
        self._options = {name: value for name, value in self._options.items() if value is not None}


_names.one_class_modules(__name__)
