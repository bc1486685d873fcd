// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/detail/on_ready_callback.hpp"

#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

#include "rclcpp/logging.hpp"
#include "rclcpp/waitable.hpp"

namespace rclcpp::detail {

thread_local bool OnReadyCallback::hands_back_ = false;

std::unique_ptr<OnReadyCallback::Target> OnReadyCallback::make_target(std::function<void(size_t)> callback,
                                                                      const char* function, const char* what) {
  if (!callback) {
    throw std::invalid_argument(std::string("The callback passed to ") + function + " is not callable.");
  }
  return std::make_unique<Target>(Target{std::move(callback), what});
}

void OnReadyCallback::call(const void* target, size_t count) {
  const Target& called = *static_cast<const Target*>(target);
  try {
    called.callback(count);
  } catch (const std::exception& error) {
    RCLCPP_ERROR(get_logger("rclcpp"), "caught exception in user-provided callback for 'on ready' of a %s: %s",
                 called.what, error.what());
  } catch (...) {
    RCLCPP_ERROR(get_logger("rclcpp"), "caught unhandled exception in user-provided callback for 'on ready' of a %s",
                 called.what);
  }
}

}  // namespace rclcpp::detail

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
