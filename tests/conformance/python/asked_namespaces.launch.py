# SPDX-License-Identifier: Apache-2.0
"""Functions on namespaces."""

from launch import LaunchDescription
from launch.actions import LogInfo
from launch_ros.utilities import make_namespace_absolute, prefix_namespace


def generate_launch_description():
    texts = [prefix_namespace('a', 'b'), prefix_namespace('/a/', 'b'), prefix_namespace('a', '/b'),
             prefix_namespace(None, 'b'),
             str(prefix_namespace(None, None)), make_namespace_absolute('x'), make_namespace_absolute('/x')]
    return LaunchDescription([
        LogInfo(msg=' '.join(texts)),
    ])
