// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/logger.hpp"

#include <rcl/logging_directory.hpp>
#include <stdexcept>

#include "rclcpp/detail/require_ok.hpp"
#include "rclcpp/exceptions.hpp"
#include "rclcpp/logging.hpp"

namespace rclcpp {

Logger get_logger(const std::string& name) {
  return Logger(name);
}

Logger Logger::get_child(const std::string& suffix) const {
  return Logger(*name_ + RCUTILS_LOGGING_SEPARATOR_STRING + suffix);
}

void Logger::set_level(Level level) {
  const rcutils_ret_t ret = rcutils_logging_set_logger_level(get_name(), static_cast<int>(level));
  if (ret != RCUTILS_RET_OK) {
    exceptions::throw_from_rcl_error(ret == RCUTILS_RET_INVALID_ARGUMENT ? RCL_RET_INVALID_ARGUMENT : RCL_RET_ERROR,
                                     "couldn't set logger level");
  }
}

Logger::Level Logger::get_effective_level() const {
  const int level = rcutils_logging_get_logger_effective_level(get_name());
  if (level < 0) {
    exceptions::throw_from_rcl_error(RCL_RET_ERROR, "couldn't get logger level");
  }
  return static_cast<Level>(level);
}

Logger get_node_logger(const rcl_node_t* node) {
  const char* const name = rcl_node_get_logger_name(node);
  if (name == nullptr) {
    Logger logger = get_logger("rclcpp");
    RCLCPP_ERROR(logger, "failed to get the name of a node's logger: %s", rcl_get_error_string().str);
    rcl_reset_error();
    return logger;
  }
  return get_logger(name);
}

void detail::log_error(rcl_ret_t ret, const char* what) {
  if (ret != RCL_RET_OK) {
    RCLCPP_ERROR(get_logger("rclcpp"), "%s: %s", what, rcl_get_error_string().str);
    rcl_reset_error();
  }
}

std::filesystem::path get_log_directory() {
  return rcl::logging_directory();
}

std::filesystem::path get_logging_directory() {
  return get_log_directory();
}

}  // namespace rclcpp
