# SPDX-License-Identifier: Apache-2.0
"""A node with a managed life cycle and the events that bring it up."""

from launch import LaunchDescription
from launch.actions import EmitEvent, RegisterEventHandler
from launch.events import matches_action
from launch_ros.actions import LifecycleNode
from launch_ros.event_handlers import OnStateTransition
from launch_ros.events.lifecycle import ChangeState
from lifecycle_msgs.msg import Transition


def generate_launch_description():
    node = LifecycleNode(package='demo', executable='managed', name='managed', namespace='', output='screen')
    return LaunchDescription([
        node,
        RegisterEventHandler(OnStateTransition(target_lifecycle_node=node, start_state='configuring',
                                               goal_state='inactive', entities=[
            EmitEvent(event=ChangeState(lifecycle_node_matcher=matches_action(node),
                                        transition_id=Transition.TRANSITION_ACTIVATE))])),
        EmitEvent(event=ChangeState(lifecycle_node_matcher=matches_action(node),
                                    transition_id=Transition.TRANSITION_CONFIGURE)),
    ])
