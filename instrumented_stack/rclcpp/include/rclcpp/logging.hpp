// SPDX-License-Identifier: Apache-2.0
// RCLCPP_{DEBUG,INFO,WARN,ERROR,FATAL}: write one log line, like printf, to the console and to /rosout.
//
//   RCLCPP_INFO(get_logger(), "got %d", 3);
//   RCLCPP_INFO_STREAM(get_logger(), "got " << 3);
//
// Each also exists with a condition. Level and condition together decide whether the line is written and its arguments
// are evaluated:
//   _ONCE(logger, …)                           the first time only
//   _EXPRESSION(logger, expression, …)         if the expression is true
//   _FUNCTION(logger, function, …)             if function() is true
//   _SKIPFIRST(logger, …)                      from the second time on
//   _THROTTLE(logger, clock, duration_ms, …)   if duration_ms have passed on the clock since the last line
//   _SKIPFIRST_THROTTLE(logger, clock, duration_ms, …)
// Each of these also exists with _STREAM. Conditions with a memory have one for each place in the source, and only
// count lines that the level lets pass.
#pragma once

#include <rcutils/logging.h>

#include <cstdint>
#include <sstream>
#include <type_traits>

#include "rclcpp/logger.hpp"
#include "rcutils/logging_macros.h"

namespace rclcpp::detail {

// The memory of the conditions, one object per place in the source. Not synchronised: a race can lose or double a line.
struct LogOnce {
  bool first = true;
  bool operator()() {
    const bool was_first = first;
    first = false;
    return was_first;
  }
};

struct LogThrottle {
  bool started = false;
  int64_t last = 0;
  bool operator()(int64_t now, int64_t duration_ms) {
    // If the clock has jumped back (simulated time restarted), the time counts as elapsed.
    if (started && now >= last && now - last < duration_ms * 1'000'000) {
      return false;
    }
    started = true;
    last = now;
    return true;
  }
};

}  // namespace rclcpp::detail

#define RCLCPP_LOG_IF_(severity, logger, condition, ...)                                                 \
  do {                                                                                                   \
    static_assert(std::is_same_v<std::decay_t<decltype(logger)>, ::rclcpp::Logger>,                      \
                  "First argument to logging macros must be an rclcpp::Logger");                         \
    static const rcutils_log_location_t rclcpp_log_location_ = {__func__, __FILE__, __LINE__};           \
    const auto& rclcpp_log_logger_ = logger;                                                             \
    if (rcutils_logging_logger_is_enabled_for(rclcpp_log_logger_.get_name(), severity) && (condition)) { \
      rcutils_log_internal(&rclcpp_log_location_, severity, rclcpp_log_logger_.get_name(), __VA_ARGS__); \
    }                                                                                                    \
  } while (0)

#define RCLCPP_LOG_STREAM_IF_(severity, logger, condition, stream_arg)                                   \
  do {                                                                                                   \
    static_assert(std::is_same_v<std::decay_t<decltype(logger)>, ::rclcpp::Logger>,                      \
                  "First argument to logging macros must be an rclcpp::Logger");                         \
    static const rcutils_log_location_t rclcpp_log_location_ = {__func__, __FILE__, __LINE__};           \
    const auto& rclcpp_log_logger_ = logger;                                                             \
    if (rcutils_logging_logger_is_enabled_for(rclcpp_log_logger_.get_name(), severity) && (condition)) { \
      std::ostringstream rclcpp_log_stream_;                                                             \
      rclcpp_log_stream_ << stream_arg;                                                                  \
      rcutils_log_internal(&rclcpp_log_location_, severity, rclcpp_log_logger_.get_name(), "%s",         \
                           rclcpp_log_stream_.str().c_str());                                            \
    }                                                                                                    \
  } while (0)

// The memory is a local static of a lambda: one per place in the source.
#define RCLCPP_LOG_ONCE_CONDITION_         \
  ([]() -> ::rclcpp::detail::LogOnce& {    \
    static ::rclcpp::detail::LogOnce once; \
    return once;                           \
  }()())
#define RCLCPP_LOG_SKIPFIRST_CONDITION_ (!RCLCPP_LOG_ONCE_CONDITION_)
#define RCLCPP_LOG_THROTTLE_CONDITION_(clock, duration) \
  ([]() -> ::rclcpp::detail::LogThrottle& {             \
    static ::rclcpp::detail::LogThrottle throttle;      \
    return throttle;                                    \
  }()((clock).now().nanoseconds(), static_cast<int64_t>(duration)))

#define RCLCPP_DEBUG(logger, ...) RCLCPP_LOG_IF_(RCUTILS_LOG_SEVERITY_DEBUG, logger, true, __VA_ARGS__)
#define RCLCPP_DEBUG_STREAM(logger, stream_arg) \
  RCLCPP_LOG_STREAM_IF_(RCUTILS_LOG_SEVERITY_DEBUG, logger, true, stream_arg)
#define RCLCPP_DEBUG_ONCE(logger, ...) \
  RCLCPP_LOG_IF_(RCUTILS_LOG_SEVERITY_DEBUG, logger, RCLCPP_LOG_ONCE_CONDITION_, __VA_ARGS__)
#define RCLCPP_DEBUG_STREAM_ONCE(logger, stream_arg) \
  RCLCPP_LOG_STREAM_IF_(RCUTILS_LOG_SEVERITY_DEBUG, logger, RCLCPP_LOG_ONCE_CONDITION_, stream_arg)
#define RCLCPP_DEBUG_EXPRESSION(logger, expression, ...) \
  RCLCPP_LOG_IF_(RCUTILS_LOG_SEVERITY_DEBUG, logger, expression, __VA_ARGS__)
#define RCLCPP_DEBUG_STREAM_EXPRESSION(logger, expression, stream_arg) \
  RCLCPP_LOG_STREAM_IF_(RCUTILS_LOG_SEVERITY_DEBUG, logger, expression, stream_arg)
#define RCLCPP_DEBUG_FUNCTION(logger, function, ...) \
  RCLCPP_LOG_IF_(RCUTILS_LOG_SEVERITY_DEBUG, logger, (function)(), __VA_ARGS__)
#define RCLCPP_DEBUG_STREAM_FUNCTION(logger, function, stream_arg) \
  RCLCPP_LOG_STREAM_IF_(RCUTILS_LOG_SEVERITY_DEBUG, logger, (function)(), stream_arg)
#define RCLCPP_DEBUG_SKIPFIRST(logger, ...) \
  RCLCPP_LOG_IF_(RCUTILS_LOG_SEVERITY_DEBUG, logger, RCLCPP_LOG_SKIPFIRST_CONDITION_, __VA_ARGS__)
#define RCLCPP_DEBUG_STREAM_SKIPFIRST(logger, stream_arg) \
  RCLCPP_LOG_STREAM_IF_(RCUTILS_LOG_SEVERITY_DEBUG, logger, RCLCPP_LOG_SKIPFIRST_CONDITION_, stream_arg)
#define RCLCPP_DEBUG_THROTTLE(logger, clock, duration, ...) \
  RCLCPP_LOG_IF_(RCUTILS_LOG_SEVERITY_DEBUG, logger, RCLCPP_LOG_THROTTLE_CONDITION_(clock, duration), __VA_ARGS__)
#define RCLCPP_DEBUG_STREAM_THROTTLE(logger, clock, duration, stream_arg) \
  RCLCPP_LOG_STREAM_IF_(RCUTILS_LOG_SEVERITY_DEBUG, logger, RCLCPP_LOG_THROTTLE_CONDITION_(clock, duration), stream_arg)
#define RCLCPP_DEBUG_SKIPFIRST_THROTTLE(logger, clock, duration, ...) \
  RCLCPP_LOG_IF_(RCUTILS_LOG_SEVERITY_DEBUG, logger,                  \
                 RCLCPP_LOG_SKIPFIRST_CONDITION_&& RCLCPP_LOG_THROTTLE_CONDITION_(clock, duration), __VA_ARGS__)
#define RCLCPP_DEBUG_STREAM_SKIPFIRST_THROTTLE(logger, clock, duration, stream_arg) \
  RCLCPP_LOG_STREAM_IF_(RCUTILS_LOG_SEVERITY_DEBUG, logger,                         \
                        RCLCPP_LOG_SKIPFIRST_CONDITION_&& RCLCPP_LOG_THROTTLE_CONDITION_(clock, duration), stream_arg)

#define RCLCPP_INFO(logger, ...) RCLCPP_LOG_IF_(RCUTILS_LOG_SEVERITY_INFO, logger, true, __VA_ARGS__)
#define RCLCPP_INFO_STREAM(logger, stream_arg) \
  RCLCPP_LOG_STREAM_IF_(RCUTILS_LOG_SEVERITY_INFO, logger, true, stream_arg)
#define RCLCPP_INFO_ONCE(logger, ...) \
  RCLCPP_LOG_IF_(RCUTILS_LOG_SEVERITY_INFO, logger, RCLCPP_LOG_ONCE_CONDITION_, __VA_ARGS__)
#define RCLCPP_INFO_STREAM_ONCE(logger, stream_arg) \
  RCLCPP_LOG_STREAM_IF_(RCUTILS_LOG_SEVERITY_INFO, logger, RCLCPP_LOG_ONCE_CONDITION_, stream_arg)
#define RCLCPP_INFO_EXPRESSION(logger, expression, ...) \
  RCLCPP_LOG_IF_(RCUTILS_LOG_SEVERITY_INFO, logger, expression, __VA_ARGS__)
#define RCLCPP_INFO_STREAM_EXPRESSION(logger, expression, stream_arg) \
  RCLCPP_LOG_STREAM_IF_(RCUTILS_LOG_SEVERITY_INFO, logger, expression, stream_arg)
#define RCLCPP_INFO_FUNCTION(logger, function, ...) \
  RCLCPP_LOG_IF_(RCUTILS_LOG_SEVERITY_INFO, logger, (function)(), __VA_ARGS__)
#define RCLCPP_INFO_STREAM_FUNCTION(logger, function, stream_arg) \
  RCLCPP_LOG_STREAM_IF_(RCUTILS_LOG_SEVERITY_INFO, logger, (function)(), stream_arg)
#define RCLCPP_INFO_SKIPFIRST(logger, ...) \
  RCLCPP_LOG_IF_(RCUTILS_LOG_SEVERITY_INFO, logger, RCLCPP_LOG_SKIPFIRST_CONDITION_, __VA_ARGS__)
#define RCLCPP_INFO_STREAM_SKIPFIRST(logger, stream_arg) \
  RCLCPP_LOG_STREAM_IF_(RCUTILS_LOG_SEVERITY_INFO, logger, RCLCPP_LOG_SKIPFIRST_CONDITION_, stream_arg)
#define RCLCPP_INFO_THROTTLE(logger, clock, duration, ...) \
  RCLCPP_LOG_IF_(RCUTILS_LOG_SEVERITY_INFO, logger, RCLCPP_LOG_THROTTLE_CONDITION_(clock, duration), __VA_ARGS__)
#define RCLCPP_INFO_STREAM_THROTTLE(logger, clock, duration, stream_arg) \
  RCLCPP_LOG_STREAM_IF_(RCUTILS_LOG_SEVERITY_INFO, logger, RCLCPP_LOG_THROTTLE_CONDITION_(clock, duration), stream_arg)
#define RCLCPP_INFO_SKIPFIRST_THROTTLE(logger, clock, duration, ...) \
  RCLCPP_LOG_IF_(RCUTILS_LOG_SEVERITY_INFO, logger,                  \
                 RCLCPP_LOG_SKIPFIRST_CONDITION_&& RCLCPP_LOG_THROTTLE_CONDITION_(clock, duration), __VA_ARGS__)
#define RCLCPP_INFO_STREAM_SKIPFIRST_THROTTLE(logger, clock, duration, stream_arg) \
  RCLCPP_LOG_STREAM_IF_(RCUTILS_LOG_SEVERITY_INFO, logger,                         \
                        RCLCPP_LOG_SKIPFIRST_CONDITION_&& RCLCPP_LOG_THROTTLE_CONDITION_(clock, duration), stream_arg)

#define RCLCPP_WARN(logger, ...) RCLCPP_LOG_IF_(RCUTILS_LOG_SEVERITY_WARN, logger, true, __VA_ARGS__)
#define RCLCPP_WARN_STREAM(logger, stream_arg) \
  RCLCPP_LOG_STREAM_IF_(RCUTILS_LOG_SEVERITY_WARN, logger, true, stream_arg)
#define RCLCPP_WARN_ONCE(logger, ...) \
  RCLCPP_LOG_IF_(RCUTILS_LOG_SEVERITY_WARN, logger, RCLCPP_LOG_ONCE_CONDITION_, __VA_ARGS__)
#define RCLCPP_WARN_STREAM_ONCE(logger, stream_arg) \
  RCLCPP_LOG_STREAM_IF_(RCUTILS_LOG_SEVERITY_WARN, logger, RCLCPP_LOG_ONCE_CONDITION_, stream_arg)
#define RCLCPP_WARN_EXPRESSION(logger, expression, ...) \
  RCLCPP_LOG_IF_(RCUTILS_LOG_SEVERITY_WARN, logger, expression, __VA_ARGS__)
#define RCLCPP_WARN_STREAM_EXPRESSION(logger, expression, stream_arg) \
  RCLCPP_LOG_STREAM_IF_(RCUTILS_LOG_SEVERITY_WARN, logger, expression, stream_arg)
#define RCLCPP_WARN_FUNCTION(logger, function, ...) \
  RCLCPP_LOG_IF_(RCUTILS_LOG_SEVERITY_WARN, logger, (function)(), __VA_ARGS__)
#define RCLCPP_WARN_STREAM_FUNCTION(logger, function, stream_arg) \
  RCLCPP_LOG_STREAM_IF_(RCUTILS_LOG_SEVERITY_WARN, logger, (function)(), stream_arg)
#define RCLCPP_WARN_SKIPFIRST(logger, ...) \
  RCLCPP_LOG_IF_(RCUTILS_LOG_SEVERITY_WARN, logger, RCLCPP_LOG_SKIPFIRST_CONDITION_, __VA_ARGS__)
#define RCLCPP_WARN_STREAM_SKIPFIRST(logger, stream_arg) \
  RCLCPP_LOG_STREAM_IF_(RCUTILS_LOG_SEVERITY_WARN, logger, RCLCPP_LOG_SKIPFIRST_CONDITION_, stream_arg)
#define RCLCPP_WARN_THROTTLE(logger, clock, duration, ...) \
  RCLCPP_LOG_IF_(RCUTILS_LOG_SEVERITY_WARN, logger, RCLCPP_LOG_THROTTLE_CONDITION_(clock, duration), __VA_ARGS__)
#define RCLCPP_WARN_STREAM_THROTTLE(logger, clock, duration, stream_arg) \
  RCLCPP_LOG_STREAM_IF_(RCUTILS_LOG_SEVERITY_WARN, logger, RCLCPP_LOG_THROTTLE_CONDITION_(clock, duration), stream_arg)
#define RCLCPP_WARN_SKIPFIRST_THROTTLE(logger, clock, duration, ...) \
  RCLCPP_LOG_IF_(RCUTILS_LOG_SEVERITY_WARN, logger,                  \
                 RCLCPP_LOG_SKIPFIRST_CONDITION_&& RCLCPP_LOG_THROTTLE_CONDITION_(clock, duration), __VA_ARGS__)
#define RCLCPP_WARN_STREAM_SKIPFIRST_THROTTLE(logger, clock, duration, stream_arg) \
  RCLCPP_LOG_STREAM_IF_(RCUTILS_LOG_SEVERITY_WARN, logger,                         \
                        RCLCPP_LOG_SKIPFIRST_CONDITION_&& RCLCPP_LOG_THROTTLE_CONDITION_(clock, duration), stream_arg)

#define RCLCPP_ERROR(logger, ...) RCLCPP_LOG_IF_(RCUTILS_LOG_SEVERITY_ERROR, logger, true, __VA_ARGS__)
#define RCLCPP_ERROR_STREAM(logger, stream_arg) \
  RCLCPP_LOG_STREAM_IF_(RCUTILS_LOG_SEVERITY_ERROR, logger, true, stream_arg)
#define RCLCPP_ERROR_ONCE(logger, ...) \
  RCLCPP_LOG_IF_(RCUTILS_LOG_SEVERITY_ERROR, logger, RCLCPP_LOG_ONCE_CONDITION_, __VA_ARGS__)
#define RCLCPP_ERROR_STREAM_ONCE(logger, stream_arg) \
  RCLCPP_LOG_STREAM_IF_(RCUTILS_LOG_SEVERITY_ERROR, logger, RCLCPP_LOG_ONCE_CONDITION_, stream_arg)
#define RCLCPP_ERROR_EXPRESSION(logger, expression, ...) \
  RCLCPP_LOG_IF_(RCUTILS_LOG_SEVERITY_ERROR, logger, expression, __VA_ARGS__)
#define RCLCPP_ERROR_STREAM_EXPRESSION(logger, expression, stream_arg) \
  RCLCPP_LOG_STREAM_IF_(RCUTILS_LOG_SEVERITY_ERROR, logger, expression, stream_arg)
#define RCLCPP_ERROR_FUNCTION(logger, function, ...) \
  RCLCPP_LOG_IF_(RCUTILS_LOG_SEVERITY_ERROR, logger, (function)(), __VA_ARGS__)
#define RCLCPP_ERROR_STREAM_FUNCTION(logger, function, stream_arg) \
  RCLCPP_LOG_STREAM_IF_(RCUTILS_LOG_SEVERITY_ERROR, logger, (function)(), stream_arg)
#define RCLCPP_ERROR_SKIPFIRST(logger, ...) \
  RCLCPP_LOG_IF_(RCUTILS_LOG_SEVERITY_ERROR, logger, RCLCPP_LOG_SKIPFIRST_CONDITION_, __VA_ARGS__)
#define RCLCPP_ERROR_STREAM_SKIPFIRST(logger, stream_arg) \
  RCLCPP_LOG_STREAM_IF_(RCUTILS_LOG_SEVERITY_ERROR, logger, RCLCPP_LOG_SKIPFIRST_CONDITION_, stream_arg)
#define RCLCPP_ERROR_THROTTLE(logger, clock, duration, ...) \
  RCLCPP_LOG_IF_(RCUTILS_LOG_SEVERITY_ERROR, logger, RCLCPP_LOG_THROTTLE_CONDITION_(clock, duration), __VA_ARGS__)
#define RCLCPP_ERROR_STREAM_THROTTLE(logger, clock, duration, stream_arg) \
  RCLCPP_LOG_STREAM_IF_(RCUTILS_LOG_SEVERITY_ERROR, logger, RCLCPP_LOG_THROTTLE_CONDITION_(clock, duration), stream_arg)
#define RCLCPP_ERROR_SKIPFIRST_THROTTLE(logger, clock, duration, ...) \
  RCLCPP_LOG_IF_(RCUTILS_LOG_SEVERITY_ERROR, logger,                  \
                 RCLCPP_LOG_SKIPFIRST_CONDITION_&& RCLCPP_LOG_THROTTLE_CONDITION_(clock, duration), __VA_ARGS__)
#define RCLCPP_ERROR_STREAM_SKIPFIRST_THROTTLE(logger, clock, duration, stream_arg) \
  RCLCPP_LOG_STREAM_IF_(RCUTILS_LOG_SEVERITY_ERROR, logger,                         \
                        RCLCPP_LOG_SKIPFIRST_CONDITION_&& RCLCPP_LOG_THROTTLE_CONDITION_(clock, duration), stream_arg)

#define RCLCPP_FATAL(logger, ...) RCLCPP_LOG_IF_(RCUTILS_LOG_SEVERITY_FATAL, logger, true, __VA_ARGS__)
#define RCLCPP_FATAL_STREAM(logger, stream_arg) \
  RCLCPP_LOG_STREAM_IF_(RCUTILS_LOG_SEVERITY_FATAL, logger, true, stream_arg)
#define RCLCPP_FATAL_ONCE(logger, ...) \
  RCLCPP_LOG_IF_(RCUTILS_LOG_SEVERITY_FATAL, logger, RCLCPP_LOG_ONCE_CONDITION_, __VA_ARGS__)
#define RCLCPP_FATAL_STREAM_ONCE(logger, stream_arg) \
  RCLCPP_LOG_STREAM_IF_(RCUTILS_LOG_SEVERITY_FATAL, logger, RCLCPP_LOG_ONCE_CONDITION_, stream_arg)
#define RCLCPP_FATAL_EXPRESSION(logger, expression, ...) \
  RCLCPP_LOG_IF_(RCUTILS_LOG_SEVERITY_FATAL, logger, expression, __VA_ARGS__)
#define RCLCPP_FATAL_STREAM_EXPRESSION(logger, expression, stream_arg) \
  RCLCPP_LOG_STREAM_IF_(RCUTILS_LOG_SEVERITY_FATAL, logger, expression, stream_arg)
#define RCLCPP_FATAL_FUNCTION(logger, function, ...) \
  RCLCPP_LOG_IF_(RCUTILS_LOG_SEVERITY_FATAL, logger, (function)(), __VA_ARGS__)
#define RCLCPP_FATAL_STREAM_FUNCTION(logger, function, stream_arg) \
  RCLCPP_LOG_STREAM_IF_(RCUTILS_LOG_SEVERITY_FATAL, logger, (function)(), stream_arg)
#define RCLCPP_FATAL_SKIPFIRST(logger, ...) \
  RCLCPP_LOG_IF_(RCUTILS_LOG_SEVERITY_FATAL, logger, RCLCPP_LOG_SKIPFIRST_CONDITION_, __VA_ARGS__)
#define RCLCPP_FATAL_STREAM_SKIPFIRST(logger, stream_arg) \
  RCLCPP_LOG_STREAM_IF_(RCUTILS_LOG_SEVERITY_FATAL, logger, RCLCPP_LOG_SKIPFIRST_CONDITION_, stream_arg)
#define RCLCPP_FATAL_THROTTLE(logger, clock, duration, ...) \
  RCLCPP_LOG_IF_(RCUTILS_LOG_SEVERITY_FATAL, logger, RCLCPP_LOG_THROTTLE_CONDITION_(clock, duration), __VA_ARGS__)
#define RCLCPP_FATAL_STREAM_THROTTLE(logger, clock, duration, stream_arg) \
  RCLCPP_LOG_STREAM_IF_(RCUTILS_LOG_SEVERITY_FATAL, logger, RCLCPP_LOG_THROTTLE_CONDITION_(clock, duration), stream_arg)
#define RCLCPP_FATAL_SKIPFIRST_THROTTLE(logger, clock, duration, ...) \
  RCLCPP_LOG_IF_(RCUTILS_LOG_SEVERITY_FATAL, logger,                  \
                 RCLCPP_LOG_SKIPFIRST_CONDITION_&& RCLCPP_LOG_THROTTLE_CONDITION_(clock, duration), __VA_ARGS__)
#define RCLCPP_FATAL_STREAM_SKIPFIRST_THROTTLE(logger, clock, duration, stream_arg) \
  RCLCPP_LOG_STREAM_IF_(RCUTILS_LOG_SEVERITY_FATAL, logger,                         \
                        RCLCPP_LOG_SKIPFIRST_CONDITION_&& RCLCPP_LOG_THROTTLE_CONDITION_(clock, duration), stream_arg)
