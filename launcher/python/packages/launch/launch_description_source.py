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
        return self._path


class _FileSource(LaunchDescriptionSource):

    def __init__(self, launch_file_path, **_options):
        super().__init__(None, launch_file_path)
