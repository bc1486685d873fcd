# SPDX-License-Identifier: Apache-2.0
"""Parameters of nodes."""

from launch._places import Located
from launch._values import LaunchFileError, text
from launch.substitutions import parts_of
from launch.utilities.type_utils import extract_type, is_text, perform_typed_substitution

_TYPES = {str: 'str', bool: 'bool', int: 'int', float: 'float'}


def _name_of_type(value_type):
    """The type as XML names it; KeyError, TypeError or ValueError for a type that a parameter can't have."""
    if value_type is None:
        return None
    scalar, is_list = extract_type(value_type)
    return f'list_of_{_TYPES[scalar]}' if is_list else _TYPES[scalar]


class ParameterValue(Located):
    """A value with its type. value_type None: the type follows from the rules of YAML."""

    def __init__(self, value, *, value_type=None):
        try:
            self._type = _name_of_type(value_type)
        except (KeyError, TypeError, ValueError):
            raise LaunchFileError(f'value_type can\'t be {value_type!r}',
                                  'use str, bool, int, float or List of one of them') from None
        self._value = value
        self.value_type = value_type

    @property
    def value(self):
        return parts_of(text(self._value, 'value')) if is_text(self._value) else self._value

    def evaluate(self, context):
        """The value with its substitutions performed."""
        return perform_typed_substitution(context, self.value, self.value_type)


class Parameter(Located):
    """A parameter by its name."""

    def __init__(self, name, value, *, value_type=None):
        self._name = text(name, 'name')
        self._value = ParameterValue(value, value_type=value_type)

    @property
    def name(self):
        return parts_of(self._name)

    @property
    def value(self):
        return self._value.value

    @property
    def value_type(self):
        return self._value.value_type

    def evaluate(self, context):
        return context._perform(self._name), self._value.evaluate(context)


class ParameterFile(Located):
    """A file of parameters; if so asked, substitutions in its text are performed."""

    def __init__(self, param_file, *, allow_substs=False):
        self._path = text(param_file, 'param_file')
        self._allow_substs = allow_substs
        self._made = None

    @property
    def param_file(self):
        return parts_of(self._path)

    @property
    def allow_substs(self):
        return parts_of(text(self._allow_substs, 'allow_substs')) if is_text(self._allow_substs) else self._allow_substs

    def evaluate(self, context):
        """The path of the file, or of a temporary file with the performed text, which cleanup() removes."""
        import pathlib
        import tempfile
        path = pathlib.Path(context._perform(self._path))
        if not perform_typed_substitution(context, self.allow_substs, bool):
            return path
        from launch.frontend.parse_substitution import parse_substitution
        content = context._perform(text(parse_substitution(path.read_text(encoding='utf-8')), 'the file'))
        self._made = self._made or tempfile.NamedTemporaryFile('w', prefix='launch_params_', suffix='.yaml')
        self._made.seek(0)
        self._made.truncate()
        self._made.write(content)
        self._made.flush()
        return pathlib.Path(self._made.name)

    def cleanup(self):
        if self._made is not None:
            self._made.close()
            self._made = None
