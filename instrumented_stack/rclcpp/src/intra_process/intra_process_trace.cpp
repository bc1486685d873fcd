// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/detail/intra_process_trace.hpp"

#include <tracetools/tracetools.h>

namespace rclcpp::detail {

void trace_construct_ring_buffer([[maybe_unused]] const void* buffer, [[maybe_unused]] size_t capacity) {
  TRACETOOLS_TRACEPOINT(rclcpp_construct_ring_buffer, buffer, capacity);
}

void trace_ring_buffer_enqueue([[maybe_unused]] const void* buffer, [[maybe_unused]] size_t index,
                               [[maybe_unused]] size_t size, [[maybe_unused]] bool overwritten) {
  TRACETOOLS_TRACEPOINT(rclcpp_ring_buffer_enqueue, buffer, index, size, overwritten);
}

void trace_ring_buffer_dequeue([[maybe_unused]] const void* buffer, [[maybe_unused]] size_t index,
                               [[maybe_unused]] size_t size) {
  TRACETOOLS_TRACEPOINT(rclcpp_ring_buffer_dequeue, buffer, index, size);
}

void trace_ring_buffer_clear([[maybe_unused]] const void* buffer) {
  TRACETOOLS_TRACEPOINT(rclcpp_ring_buffer_clear, buffer);
}

void trace_buffer_to_ipb([[maybe_unused]] const void* buffer, [[maybe_unused]] const void* ipb) {
  TRACETOOLS_TRACEPOINT(rclcpp_buffer_to_ipb, buffer, ipb);
}

void trace_ipb_to_subscription([[maybe_unused]] const void* ipb, [[maybe_unused]] const void* subscription) {
  TRACETOOLS_TRACEPOINT(rclcpp_ipb_to_subscription, ipb, subscription);
}

void trace_ring_buffer_fini([[maybe_unused]] const void* buffer) {
  TRACETOOLS_EXT_TRACEPOINT(rclcpp_ring_buffer_fini, buffer);
}

void trace_ipb_fini([[maybe_unused]] const void* ipb) {
  TRACETOOLS_EXT_TRACEPOINT(rclcpp_ipb_fini, ipb);
}

void trace_intra_process_fini([[maybe_unused]] const void* subscription, [[maybe_unused]] const void* callback) {
  TRACETOOLS_EXT_TRACEPOINT(rclcpp_callback_fini, callback);
  TRACETOOLS_EXT_TRACEPOINT(rclcpp_subscription_fini, subscription);
}

}  // namespace rclcpp::detail
