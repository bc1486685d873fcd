# SPDX-License-Identifier: Apache-2.0
"""Descriptions of programs."""

from launch import _names
from launch._places import Located
from launch._values import mapping, pairs, text, words
from launch.substitutions import parts_of


class Executable(Located):
    """A program with its arguments and its environment."""

    _OPTIONS = ('prefix', 'name', 'cwd', 'env', 'additional_env')

    # Known only while the program runs; None before.
    final_name = final_cmd = final_cwd = final_env = None

    def __init__(self, *, cmd, prefix=None, name=None, cwd=None, env=None, additional_env=None, arguments=None):
        self._arguments = words(arguments or [], 'arguments')
        self.cmd = [parts_of(word) for word in words(cmd, 'cmd') + self._arguments]
        self._options = {'prefix': prefix, 'name': name, 'cwd': cwd, 'env': env, 'additional_env': additional_env}
        self._options = {name: value for name, value in self._options.items() if value is not None}

    # A file may have changed the list.
    @property
    def _command(self):
        return words(self.cmd, 'cmd')

    @property
    def arguments(self):
        return [parts_of(word) for word in self._arguments]

    @property
    def name(self):
        return self._parts('name')

    @property
    def cwd(self):
        return self._parts('cwd')

    @property
    def prefix(self):
        return self._parts('prefix') or []

    @property
    def env(self):
        return self._variables('env')

    @property
    def additional_env(self):
        return self._variables('additional_env')

    def prepare(self, _context, _action):
        """ROS 2 performs the substitutions here; the launcher does so when it starts the program."""

    def _parts(self, option):
        value = self._options.get(option)
        return None if value is None else parts_of(text(value, option))

    def _variables(self, option):
        value = self._options.get(option)
        return None if value is None else [(parts_of(name), parts_of(content))
                                           for name, content in pairs(mapping(value, option), option)]


_names.one_class_modules(__name__)
