# SPDX-License-Identifier: Apache-2.0
"""Parameters of all types."""

from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(package='demo', executable='talker', parameters=[{
            'whole': 1, 'real': 1.5, 'yes': True, 'text': 'a text', 'number_as_text': '1',
            'boolean_as_text': 'true', 'empty': '',
            'wholes': [1, 2], 'reals': [1.0, 2.5], 'mixed_numbers': [1.0, 2.0], 'booleans': [True, False],
            'texts': ['a', '1'],
            'nested': {'inner': 1, 'deeper': {'x': 'y'}}, 'with.dots': 2, 'negative': -3, 'large': 1e10,
            'small': 1e-7}]),
    ])
