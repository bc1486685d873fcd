// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/waitable.hpp"

#include <stdexcept>

namespace rclcpp {

std::shared_ptr<void> Waitable::take_data_by_entity_id(size_t) {
  throw std::runtime_error("Custom waitables should override take_data_by_entity_id if they want to use it.");
}

void Waitable::set_on_ready_callback(std::function<void(size_t, int)>) {
  throw std::runtime_error("Custom waitables should override set_on_ready_callback if they want to use it.");
}

void Waitable::clear_on_ready_callback() {
  throw std::runtime_error(
      "Custom waitables should override clear_on_ready_callback if they want to use it and make "
      "sure to call it on the waitable destructor.");
}

}  // namespace rclcpp
