# SPDX-License-Identifier: Apache-2.0
"""Events of ROS nodes."""

from launch_ros.events import lifecycle

matches_node_name = lifecycle.matches_node_name
__all__ = ['lifecycle', 'matches_node_name']
