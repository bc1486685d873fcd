# SPDX-License-Identifier: Apache-2.0
"""A change of state for the nodes that a function accepts."""

from launch import LaunchDescription
from launch.actions import EmitEvent, LogInfo
from launch_ros.actions import LifecycleNode
from launch_ros.events.lifecycle import ChangeState
from lifecycle_msgs.msg import State, Transition


def generate_launch_description():
    nodes = [LifecycleNode(package='demo', executable='managed', name=f'm{i}', namespace='') for i in range(2)]
    states = [State.PRIMARY_STATE_ACTIVE, State.TRANSITION_STATE_CONFIGURING]
    return LaunchDescription([
        *nodes,
        LogInfo(msg=str(states)),
        EmitEvent(event=ChangeState(lifecycle_node_matcher=lambda action: action in nodes,
                                    transition_id=Transition.TRANSITION_CONFIGURE)),
    ])
