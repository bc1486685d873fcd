// SPDX-License-Identifier: Apache-2.0
#include "rcl/logging.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <stdexcept>

#include "arguments/arguments_impl.hpp"
#include "logging/log_backend.hpp"
#include "rcl/error_handling.h"
#include "rcl/logging_rosout.h"
#include "rcutils/format_log_line.hpp"

namespace {

// The outputs of messages. Before rcl_logging_configure() it is only the console.
std::atomic<bool> to_stdout{true};
std::atomic<bool> to_rosout{false};

// It may be replaced while other threads write.
class CurrentExternalLog {
 public:
  std::shared_ptr<rcl::ExternalLog> get() const {
    const std::lock_guard lock(mutex_);
    return log_;
  }
  void set(std::shared_ptr<rcl::ExternalLog> log) {
    const std::lock_guard lock(mutex_);
    log_.swap(log);
  }

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<rcl::ExternalLog> log_;
};

// Never destroyed, because static objects of other libraries may log while the process ends.
CurrentExternalLog& external_log() {
  static CurrentExternalLog& instance = *new CurrentExternalLog;
  return instance;
}

}  // namespace

rcl_ret_t rcl_logging_configure(const rcl_arguments_t* global_args, const rcl_allocator_t* allocator) {
  return rcl_logging_configure_with_output_handler(global_args, allocator, rcl_logging_multiple_output_handler);
}

rcl_ret_t rcl_logging_configure_with_output_handler(const rcl_arguments_t* global_args, const rcl_allocator_t*,
                                                    rcutils_logging_output_handler_t output_handler) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(global_args, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(global_args->impl, RCL_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(output_handler, RCL_RET_INVALID_ARGUMENT);
  if (rcutils_logging_initialize() != RCUTILS_RET_OK) {
    return RCL_RET_ERROR;
  }
  const rcl_arguments_impl_t& arguments = *global_args->impl;
  if (arguments.default_log_level) {
    rcutils_logging_set_default_logger_level(*arguments.default_log_level);
  }
  for (const auto& [logger, level] : arguments.logger_levels) {
    if (rcutils_logging_set_logger_level(logger.c_str(), level) != RCUTILS_RET_OK) {
      return RCL_RET_ERROR;
    }
  }
  to_stdout = arguments.stdout_logs;
  to_rosout = arguments.rosout_logs;
  external_log().set(nullptr);
  if (arguments.external_logs) {
    try {
      external_log().set(rcl::open_external_log(arguments.log_file_name, arguments.log_config_file,
                                                rcutils_logging_get_default_logger_level()));
    } catch (const std::runtime_error& error) {
      rcutils_reset_error();  // the backend's own, which stands in this one
      RCL_SET_ERROR_MSG(error.what());
      return RCL_RET_ERROR;
    }
  }
  rcutils_logging_set_output_handler(output_handler);
  return RCL_RET_OK;
}

rcl_ret_t rcl_logging_fini(void) {
  rcutils_logging_set_output_handler(rcutils_logging_console_output_handler);
  to_stdout = true;
  to_rosout = false;
  external_log().set(nullptr);
  return RCL_RET_OK;
}

bool rcl_logging_rosout_enabled(void) {
  return to_rosout;
}

void rcl_logging_multiple_output_handler(const rcutils_log_location_t* location, int severity, const char* name,
                                         rcutils_time_point_value_t timestamp, const char* format, va_list* args) {
  if (to_stdout) {
    rcutils_logging_console_output_handler(location, severity, name, timestamp, format, args);
  }
  if (const std::shared_ptr<rcl::ExternalLog> log = external_log().get()) {
    log->write(severity, name, rcutils::format_log_line(location, severity, name, timestamp, format, args));
  }
  if (to_rosout) {
    rcl_logging_rosout_output_handler(location, severity, name, timestamp, format, args);
  }
}
