# SPDX-License-Identifier: Apache-2.0
"""LaunchDescriptionSource: where an included launch description comes from."""

from launch._places import Located
from launch._values import LaunchFileError, text
from launch.launch_description import LaunchDescription


class LaunchDescriptionSource(Located):
    """A launch description that exists already, or the path of a launch file of any format."""

    def __init__(self, launch_description=None, location='', method='unspecified mechanism from a script'):
        self._description = launch_description if isinstance(launch_description, LaunchDescription) else None
        if launch_description is not None and self._description is None:
            raise LaunchFileError('launch_description must be a LaunchDescription, '
                                  f'got {type(launch_description).__name__}')
        self._path = text(location, 'location')
        self.method = method

    @property
    def location(self):
        return ''.join(part if isinstance(part, str) else part.describe() for part in self._path)

    def try_get_launch_description_without_context(self):
        """The description, if it exists already or is that of a file whose path is known; None otherwise."""
        if self._description is None and all(isinstance(part, str) for part in self._path) and self._path:
            return self._read(''.join(self._path))
        return self._description

    def get_launch_description(self, context):
        """The description: what a Python file returns, or one that includes a file of another format."""
        return self._description if self._description is not None else self._read(context._perform(self._path))

    def _read(self, path):
        from launch.launch_description_sources import (
            get_launch_description_from_any_launch_file, get_launch_description_from_python_launch_file)
        if path.endswith('.py'):
            return get_launch_description_from_python_launch_file(path)
        return get_launch_description_from_any_launch_file(path)


class _FileSource(LaunchDescriptionSource):

    def __init__(self, launch_file_path, **_options):
        super().__init__(None, launch_file_path)
