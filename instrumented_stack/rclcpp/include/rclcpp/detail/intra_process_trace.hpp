// SPDX-License-Identifier: Apache-2.0
// The trace events that templates of intra-process delivery fire. They are here so that users of rclcpp need no
// tracetools.
#pragma once

#include <cstddef>

namespace rclcpp::detail {

void trace_construct_ring_buffer(const void* buffer, size_t capacity);
void trace_ring_buffer_enqueue(const void* buffer, size_t index, size_t size, bool overwritten);
void trace_ring_buffer_dequeue(const void* buffer, size_t index, size_t size);
void trace_ring_buffer_clear(const void* buffer);
void trace_buffer_to_ipb(const void* buffer, const void* ipb);
void trace_ipb_to_subscription(const void* ipb, const void* subscription);

// Record the end of these objects.
void trace_ring_buffer_fini(const void* buffer);
void trace_ipb_fini(const void* ipb);
void trace_intra_process_fini(const void* subscription, const void* callback);

}  // namespace rclcpp::detail
