# SPDX-License-Identifier: Apache-2.0
"""Runs a launch file."""

import sys
import types

import _launch_engine
from launch import LaunchDescription
from launch._entities import entities
from launch._environment import replace_os_environ
from launch._places import note_source, of_function
from launch._values import LaunchFileError, name_of


def _program_arguments():
    # As `ros2 launch` sets them: some launch files look for their arguments here.
    try:
        with open('/proc/self/cmdline', encoding='utf-8', errors='surrogateescape') as file:
            words = file.read().split('\0')[:-1]
    except OSError:
        words = ['launch']
    return [words[0], 'launch', *words[1:]]


def load(path, source):
    """The entities of a launch file, in the launcher's own Python."""
    replace_os_environ()
    sys.argv = _program_arguments()
    return load_file(path, source)


def _decoded(source):
    if isinstance(source, str):
        return source
    try:
        return source.decode('utf-8-sig')
    except UnicodeDecodeError:
        return source.decode('latin-1')  # for the places of errors; compile() follows a `coding:` line


def load_file(path, source):
    """The entities that generate_launch_description() of the file returns."""
    note_source(path, _decoded(source))
    code = compile(source, path, 'exec', dont_inherit=True)
    module = types.ModuleType('python_launch_file')
    module.__file__ = path
    exec(code, module.__dict__)
    generate = getattr(module, 'generate_launch_description', None)
    if generate is None:
        raise LaunchFileError('the launch file has no generate_launch_description()',
                              'a Python launch file defines that function; it returns a LaunchDescription')
    description = generate()
    if not isinstance(description, LaunchDescription):
        raise LaunchFileError(
            f'generate_launch_description() must return a LaunchDescription, got {name_of(description)}',
            'write return LaunchDescription([…])', of_function(generate))
    if description.deprecated:
        _launch_engine.message('warning', 'launch', f'launch file [{path}] is deprecated: {description.deprecated_reason}')
    return entities(description)
