# SPDX-License-Identifier: Apache-2.0
"""Launch files by their path. The launcher detects the format itself, so all of these classes mean the same."""

import os

from launch import _names
from launch.launch_description_source import LaunchDescriptionSource, _FileSource


class AnyLaunchDescriptionSource(_FileSource):
    pass


class PythonLaunchDescriptionSource(_FileSource):
    pass


class FrontendLaunchDescriptionSource(_FileSource):
    pass


class XMLLaunchDescriptionSource(_FileSource):
    pass


class YAMLLaunchDescriptionSource(_FileSource):
    pass


class InvalidLaunchFileError(Exception):
    pass


class InvalidPythonLaunchFileError(Exception):
    pass


def load_python_launch_file_as_module(python_launch_file_path):
    """Runs a Python launch file and returns it as a module."""
    from importlib.machinery import SourceFileLoader
    from importlib.util import module_from_spec, spec_from_loader
    path = os.fspath(python_launch_file_path)
    loader = SourceFileLoader('python_launch_file', path)
    module = module_from_spec(spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module


def get_launch_description_from_python_launch_file(python_launch_file_path):
    """What generate_launch_description() of the file returns."""
    module = load_python_launch_file_as_module(python_launch_file_path)
    if not hasattr(module, 'generate_launch_description'):
        raise InvalidPythonLaunchFileError(
            f"launch file at '{python_launch_file_path}' has no generate_launch_description()")
    return module.generate_launch_description()


def get_launch_description_from_any_launch_file(launch_file_path, **_options):
    """A description that includes the file."""
    from launch import LaunchDescription
    from launch.actions import IncludeLaunchDescription
    return LaunchDescription([IncludeLaunchDescription(AnyLaunchDescriptionSource(os.fspath(launch_file_path)))])


get_launch_description_from_frontend_launch_file = get_launch_description_from_any_launch_file


class InvalidFrontendLaunchFileError(InvalidLaunchFileError):
    pass


_names.one_class_modules(__name__)
_names.same_module(__name__, __name__ + '.python_launch_file_utilities', __name__ + '.any_launch_file_utilities',
                   __name__ + '.frontend_launch_file_utilities')
_names.same_module('launch.launch_description_sources', 'launch.invalid_launch_file_error')
__all__ = ['AnyLaunchDescriptionSource', 'FrontendLaunchDescriptionSource', 'LaunchDescriptionSource',
           'PythonLaunchDescriptionSource', 'XMLLaunchDescriptionSource', 'YAMLLaunchDescriptionSource']
