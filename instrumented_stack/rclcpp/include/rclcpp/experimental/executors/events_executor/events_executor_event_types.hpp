// SPDX-License-Identifier: Apache-2.0
// The events in the queue of an events executor.
#pragma once

#include <cstddef>

namespace rclcpp::experimental::executors {

enum ExecutorEventType { CLIENT_EVENT, SUBSCRIPTION_EVENT, SERVICE_EVENT, TIMER_EVENT, WAITABLE_EVENT };

struct ExecutorEvent {
  const void* entity_key;  // the address of the entity, which may be destroyed
  int waitable_data;       // which entity of a waitable
  ExecutorEventType type;
  size_t num_events;
};

}  // namespace rclcpp::experimental::executors
