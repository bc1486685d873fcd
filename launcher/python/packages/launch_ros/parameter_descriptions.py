# SPDX-License-Identifier: Apache-2.0
"""Parameters of nodes."""

from typing import List

from launch._places import Located
from launch._values import LaunchFileError, text

_TYPES = {None: None, str: 'str', bool: 'bool', int: 'int', float: 'float', List[str]: 'list_of_str',
          List[bool]: 'list_of_bool', List[int]: 'list_of_int', List[float]: 'list_of_float',
          list[str]: 'list_of_str', list[bool]: 'list_of_bool', list[int]: 'list_of_int', list[float]: 'list_of_float'}


class ParameterValue(Located):
    """A value with its type. value_type None: the type follows from the rules of YAML."""

    def __init__(self, value, *, value_type=None):
        try:
            self._type = _TYPES[value_type]
        except (KeyError, TypeError):
            raise LaunchFileError(f'value_type can\'t be {value_type!r}',
                                  'use str, bool, int, float or List of one of them') from None
        self.value = value
        self.value_type = value_type


class Parameter(Located):
    """A parameter by its name."""

    def __init__(self, name, value, *, value_type=None):
        self.name = text(name, 'name')
        self._value = ParameterValue(value, value_type=value_type)

    @property
    def value(self):
        return self._value.value


class ParameterFile(Located):
    """A file of parameters; if so asked, substitutions in its text are performed."""

    def __init__(self, param_file, *, allow_substs=False):
        self._path = text(param_file, 'param_file')
        self._allow_substs = allow_substs

    @property
    def param_file(self):
        return self._path
