# SPDX-License-Identifier: Apache-2.0
"""Names of ROS 2's package launch_yaml. The format itself is the launcher's own."""

from launch import _names
from launch.launch_description_sources import YAMLLaunchDescriptionSource
from launch.frontend import Entity, Parser

_names.same_module('launch.launch_description_sources', __name__ + '.launch_description_sources',
                   __name__ + '.launch_description_sources.yaml_launch_description_source')
_names.same_module('launch.frontend', __name__ + '.entity', __name__ + '.parser')
__all__ = ['Entity', 'Parser', 'YAMLLaunchDescriptionSource']
