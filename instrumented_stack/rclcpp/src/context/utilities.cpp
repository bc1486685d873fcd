// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/utilities.hpp"

#include <utility>

#include "rclcpp/detail/rcl_arguments.hpp"

namespace rclcpp {

namespace {

Context::SharedPtr or_default(Context::SharedPtr context) {
  return context ? std::move(context) : contexts::get_global_default_context();
}

}  // namespace

void init(int argc, char const* const* argv, const InitOptions& init_options,
          SignalHandlerOptions signal_handler_options) {
  contexts::get_global_default_context()->init(argc, argv, init_options);
  install_signal_handlers(signal_handler_options);
}

std::vector<std::string> init_and_remove_ros_arguments(int argc, char const* const* argv,
                                                       const InitOptions& init_options) {
  init(argc, argv, init_options);
  return remove_ros_arguments(argc, argv);
}

std::vector<std::string> remove_ros_arguments(int argc, char const* const* argv) {
  return detail::without_ros_arguments(argc, argv);
}

bool ok(Context::SharedPtr context) {
  return context ? context->is_valid() : contexts::get_global_default_context()->is_valid();
}

bool shutdown(Context::SharedPtr context, const std::string& reason) {
  const Context::SharedPtr default_context = contexts::get_global_default_context();
  if (!context) {
    context = default_context;
  }
  const bool was_valid = context->shutdown(reason);
  if (context == default_context) {
    uninstall_signal_handlers();
  }
  return was_valid;
}

void on_shutdown(std::function<void()> callback, Context::SharedPtr context) {
  or_default(std::move(context))->on_shutdown(std::move(callback));
}

bool sleep_for(const std::chrono::nanoseconds& nanoseconds, Context::SharedPtr context) {
  return or_default(std::move(context))->sleep_for(nanoseconds);
}

}  // namespace rclcpp
