# SPDX-License-Identifier: Apache-2.0
"""The launch file that `launch_test` hands to the launcher."""

from launch_testing._conductor import launch_description_of_order


def generate_launch_description():
    return launch_description_of_order()
