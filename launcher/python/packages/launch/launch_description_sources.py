"""Launch files by their path. The launcher sees the format itself, so that all of these mean the same."""

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


_names.one_class_modules(__name__)
__all__ = ['AnyLaunchDescriptionSource', 'FrontendLaunchDescriptionSource', 'LaunchDescriptionSource',
           'PythonLaunchDescriptionSource', 'XMLLaunchDescriptionSource', 'YAMLLaunchDescriptionSource']
