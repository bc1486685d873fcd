// SPDX-License-Identifier: Apache-2.0
// Functions that a program sets for the events of a publisher or a subscription, beside their handlers.
#pragma once

#include <functional>
#include <stdexcept>
#include <utility>

#include "rclcpp/logging.hpp"

namespace rclcpp::detail {

template <typename HandlersT, typename EventTypeT>
void set_on_event(const HandlersT& handlers, EventTypeT event_type, std::function<void(size_t)> callback,
                  const char* kind) {
  const auto handler = handlers.find(event_type);
  if (handler == handlers.end()) {
    RCLCPP_WARN(get_logger("rclcpp"), "Calling set_on_new_qos_event_callback for non registered %s event_type", kind);
    return;
  }
  if (!callback) {
    throw std::invalid_argument("The callback passed to set_on_new_qos_event_callback is not callable.");
  }
  handler->second->set_on_ready_callback([callback = std::move(callback)](size_t count, int) { callback(count); });
}

template <typename HandlersT, typename EventTypeT>
void clear_on_event(const HandlersT& handlers, EventTypeT event_type) {
  const auto handler = handlers.find(event_type);
  if (handler == handlers.end()) {
    RCLCPP_WARN(get_logger("rclcpp"), "Calling clear_on_new_qos_event_callback for non registered event_type");
    return;
  }
  handler->second->clear_on_ready_callback();
}

}  // namespace rclcpp::detail
