// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/logger.hpp"

#include <rcl/logging_directory.hpp>
#include <stdexcept>

#include "rclcpp/exceptions.hpp"

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

std::filesystem::path get_logging_directory() {
  return rcl::logging_directory();
}

}  // namespace rclcpp
