#include "rclcpp/waitable.hpp"

#include <stdexcept>

namespace rclcpp {

std::shared_ptr<void> Waitable::take_data_by_entity_id(size_t /*id*/) {
  throw std::runtime_error(
      "Custom waitables should override take_data_by_entity_id if they want to use set_on_ready_callback");
}

void Waitable::set_on_ready_callback(std::function<void(size_t, int)> /*callback*/) {
  throw std::runtime_error("Custom waitables should override set_on_ready_callback if they want to use it.");
}

void Waitable::clear_on_ready_callback() {
  throw std::runtime_error("Custom waitables should override clear_on_ready_callback if they want to use it.");
}

}  // namespace rclcpp
