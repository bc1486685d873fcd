# SPDX-License-Identifier: Apache-2.0
"""Actions of launch descriptions for tests."""

from launch_testing.actions import ReadyToTest

__all__ = ['ReadyToTest']
