# SPDX-License-Identifier: Apache-2.0
"""Lists of names that traces are asked for with."""

from tracetools_trace.tools import tracepoints

DEFAULT_EVENTS_ROS = [
    tracepoints.rcl_init,
    tracepoints.rcl_node_init,
    tracepoints.rmw_publisher_init,
    tracepoints.rcl_publisher_init,
    tracepoints.rclcpp_publish,
    tracepoints.rclcpp_intra_publish,
    tracepoints.rcl_publish,
    tracepoints.rmw_publish,
    tracepoints.rmw_subscription_init,
    tracepoints.rcl_subscription_init,
    tracepoints.rclcpp_subscription_init,
    tracepoints.rclcpp_subscription_callback_added,
    tracepoints.rmw_take,
    tracepoints.rcl_take,
    tracepoints.rclcpp_take,
    tracepoints.rcl_service_init,
    tracepoints.rclcpp_service_callback_added,
    tracepoints.rmw_take_request,
    tracepoints.rmw_send_response,
    tracepoints.rmw_client_init,
    tracepoints.rcl_client_init,
    tracepoints.rmw_send_request,
    tracepoints.rmw_take_response,
    tracepoints.rcl_timer_init,
    tracepoints.rclcpp_timer_callback_added,
    tracepoints.rclcpp_timer_link_node,
    tracepoints.rclcpp_callback_register,
    tracepoints.callback_start,
    tracepoints.callback_end,
    tracepoints.rcl_lifecycle_state_machine_init,
    tracepoints.rcl_lifecycle_transition,
    tracepoints.rclcpp_executor_get_next_ready,
    tracepoints.rclcpp_executor_wait_for_work,
    tracepoints.rclcpp_executor_execute,
    tracepoints.rclcpp_ipb_to_subscription,
    tracepoints.rclcpp_buffer_to_ipb,
    tracepoints.rclcpp_construct_ring_buffer,
    tracepoints.rclcpp_ring_buffer_enqueue,
    tracepoints.rclcpp_ring_buffer_dequeue,
    tracepoints.rclcpp_ring_buffer_clear,
    tracepoints.message_link_periodic_async,
    tracepoints.message_link_partial_sync,
]

DEFAULT_INIT_EVENTS_ROS = [
    tracepoints.rcl_init,
    tracepoints.rcl_node_init,
    tracepoints.rmw_publisher_init,
    tracepoints.rcl_publisher_init,
    tracepoints.rmw_subscription_init,
    tracepoints.rcl_subscription_init,
    tracepoints.rclcpp_subscription_init,
    tracepoints.rclcpp_subscription_callback_added,
    tracepoints.rcl_service_init,
    tracepoints.rclcpp_service_callback_added,
    tracepoints.rmw_client_init,
    tracepoints.rcl_client_init,
    tracepoints.rcl_timer_init,
    tracepoints.rclcpp_timer_callback_added,
    tracepoints.rclcpp_timer_link_node,
    tracepoints.rclcpp_callback_register,
    tracepoints.rcl_lifecycle_state_machine_init,
    tracepoints.rclcpp_ipb_to_subscription,
    tracepoints.rclcpp_buffer_to_ipb,
    tracepoints.rclcpp_construct_ring_buffer,
    tracepoints.message_link_periodic_async,
    tracepoints.message_link_partial_sync,
]

DEFAULT_EVENTS_UST = DEFAULT_EVENTS_ROS

# What analyses use.
DEFAULT_EVENTS_KERNEL = ['sched_switch', 'kmem_mm_page_alloc', 'kmem_mm_page_free', 'power_cpu_frequency']

DOMAIN_TYPE_KERNEL = 'kernel'
DOMAIN_TYPE_USERSPACE = 'userspace'

DEFAULT_CONTEXT = ['procname', 'vpid', 'vtid']
