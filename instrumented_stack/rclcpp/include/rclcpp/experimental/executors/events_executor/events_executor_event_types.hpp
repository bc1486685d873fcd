// SPDX-License-Identifier: Apache-2.0
// What an events executor keeps in its queue.
#pragma once

#include <cstddef>

namespace rclcpp::experimental::executors {

enum ExecutorEventType { CLIENT_EVENT, SUBSCRIPTION_EVENT, SERVICE_EVENT, TIMER_EVENT, WAITABLE_EVENT };

struct ExecutorEvent {
  const void* entity_key;  // the address of the entity, which may be gone
  int waitable_data;       // which of a waitable's entities
  ExecutorEventType type;
  size_t num_events;
};

}  // namespace rclcpp::experimental::executors
