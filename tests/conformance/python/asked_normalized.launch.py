# SPDX-License-Identifier: Apache-2.0
"""Values that are normalised and performed."""

from typing import List

from launch import LaunchDescription
from launch.actions import LogInfo, OpaqueFunction, SetLaunchConfiguration
from launch.substitutions import LaunchConfiguration
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch.utilities.type_utils import get_typed_value, normalize_typed_substitution, perform_typed_substitution


def launch_setup(context):
    texts = normalize_to_list_of_substitutions(['a', LaunchConfiguration('n')])
    typed = perform_typed_substitution(context, normalize_typed_substitution(LaunchConfiguration('n'), int), int)
    values = [perform_substitutions(context, texts), typed, get_typed_value('1.5', float),
              get_typed_value('[a, b]', List[str])]
    return [LogInfo(msg=' '.join(map(repr, values)))]


def generate_launch_description():
    return LaunchDescription([
        SetLaunchConfiguration('n', '7'),
        OpaqueFunction(function=launch_setup),
    ])
