# SPDX-License-Identifier: Apache-2.0
"""Names that packages use to offer their actions to XML and YAML files. Here those formats are the launcher's own."""

from launch import _names


class Entity:
    pass


class Parser:
    pass


def expose_action(_name):
    return lambda cls: cls


def expose_substitution(_name):
    return lambda cls: cls


_names.one_class_modules(__name__)
_names.same_module(__name__, __name__ + '.expose')
