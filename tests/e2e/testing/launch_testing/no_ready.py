# SPDX-License-Identifier: Apache-2.0
# The description lacks ReadyToTest.
import launch


def generate_test_description():
    return launch.LaunchDescription([])
