// SPDX-License-Identifier: Apache-2.0
// A name for log lines. Names are hierarchical: "a.b" has the level of "a" until it gets one of its own.
#pragma once

#include <rcl/node.h>
#include <rcutils/logging.h>

#include <filesystem>
#include <memory>
#include <string>

namespace rclcpp {

class Logger {
 public:
  enum class Level {
    Unset = RCUTILS_LOG_SEVERITY_UNSET,
    Debug = RCUTILS_LOG_SEVERITY_DEBUG,
    Info = RCUTILS_LOG_SEVERITY_INFO,
    Warn = RCUTILS_LOG_SEVERITY_WARN,
    Error = RCUTILS_LOG_SEVERITY_ERROR,
    Fatal = RCUTILS_LOG_SEVERITY_FATAL,
  };

  const char* get_name() const { return name_ ? name_->c_str() : nullptr; }
  Logger get_child(const std::string& suffix) const;

  // Unset removes the level, so that the parent's level applies again.
  void set_level(Level level);
  Level get_effective_level() const;

 private:
  friend Logger get_logger(const std::string& name);
  explicit Logger(const std::string& name) : name_(std::make_shared<const std::string>(name)) {}

  std::shared_ptr<const std::string> name_;
};

Logger get_logger(const std::string& name);
// The logger of a node of rcl. For an invalid node it is the logger "rclcpp", which logs the error.
Logger get_node_logger(const rcl_node_t* node);

// The folder of this process's log files, even before any exist. The second name is that of versions before 29.
std::filesystem::path get_log_directory();
std::filesystem::path get_logging_directory();

}  // namespace rclcpp
