# SPDX-License-Identifier: Apache-2.0
"""Something that is no action."""

from launch import LaunchDescription


def generate_launch_description():
    return LaunchDescription([
        'a text',
    ])
