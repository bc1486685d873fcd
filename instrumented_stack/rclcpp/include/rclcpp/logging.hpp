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

// Of _FUNCTION: a function, something that can be called, or a pointer to it.
template <class Function>
bool is_true(Function&& function) {
  if constexpr (std::is_invocable_v<Function>) {
    return function();
  } else {
    return (*function)();
  }
}

}  // namespace rclcpp::detail

// The two forms of a line. `before` is done if the line is written, before its arguments are evaluated.
#define RCLCPP_LOG_(severity, logger, condition, before, ...)                                                   \
  do {                                                                                                          \
    static_assert(std::is_convertible_v<decltype(logger), ::rclcpp::Logger>,                                    \
                  "First argument to logging macros must be an rclcpp::Logger");                                \
    static const rcutils_log_location_t rclcpp_log_location_ = {__func__, __FILE__, __LINE__};                  \
    const ::rclcpp::Logger& rclcpp_log_logger_ = logger;                                                        \
    if (rcutils_logging_logger_is_enabled_for(rclcpp_log_logger_.get_name(), severity) && (condition)) {        \
      before rcutils_log_internal(&rclcpp_log_location_, severity, rclcpp_log_logger_.get_name(), __VA_ARGS__); \
    }                                                                                                           \
  } while (0)
#define RCLCPP_LOG_TEXT_(severity, logger, condition, ...) RCLCPP_LOG_(severity, logger, condition, , __VA_ARGS__)
#define RCLCPP_LOG_STREAM_(severity, logger, condition, stream_arg)                                                 \
  RCLCPP_LOG_(severity, logger, condition, std::ostringstream rclcpp_log_stream_; rclcpp_log_stream_ << stream_arg; \
              , "%s", rclcpp_log_stream_.str().c_str())

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

// The conditions. `form` is TEXT or STREAM. The level is joined to a name before it could be replaced, in case a
// program defines a macro DEBUG or ERROR.
#define RCLCPP_LOG_ALWAYS_(form, level, logger, ...) \
  RCLCPP_LOG_##form##_(RCUTILS_LOG_SEVERITY_##level, logger, true, __VA_ARGS__)
#define RCLCPP_LOG_ONCE_(form, level, logger, ...) \
  RCLCPP_LOG_##form##_(RCUTILS_LOG_SEVERITY_##level, logger, RCLCPP_LOG_ONCE_CONDITION_, __VA_ARGS__)
#define RCLCPP_LOG_EXPRESSION_(form, level, logger, expression, ...) \
  RCLCPP_LOG_##form##_(RCUTILS_LOG_SEVERITY_##level, logger, expression, __VA_ARGS__)
#define RCLCPP_LOG_FUNCTION_(form, level, logger, function, ...) \
  RCLCPP_LOG_##form##_(RCUTILS_LOG_SEVERITY_##level, logger, ::rclcpp::detail::is_true(function), __VA_ARGS__)
#define RCLCPP_LOG_SKIPFIRST_(form, level, logger, ...) \
  RCLCPP_LOG_##form##_(RCUTILS_LOG_SEVERITY_##level, logger, RCLCPP_LOG_SKIPFIRST_CONDITION_, __VA_ARGS__)
#define RCLCPP_LOG_THROTTLE_(form, level, logger, clock, duration, ...)                                       \
  RCLCPP_LOG_##form##_(RCUTILS_LOG_SEVERITY_##level, logger, RCLCPP_LOG_THROTTLE_CONDITION_(clock, duration), \
                       __VA_ARGS__)
#define RCLCPP_LOG_SKIPFIRST_THROTTLE_(form, level, logger, clock, duration, ...) \
  RCLCPP_LOG_##form##_(RCUTILS_LOG_SEVERITY_##level, logger,                      \
                       RCLCPP_LOG_SKIPFIRST_CONDITION_&& RCLCPP_LOG_THROTTLE_CONDITION_(clock, duration), __VA_ARGS__)

#define RCLCPP_DEBUG(...) RCLCPP_LOG_ALWAYS_(TEXT, DEBUG, __VA_ARGS__)
#define RCLCPP_DEBUG_ONCE(...) RCLCPP_LOG_ONCE_(TEXT, DEBUG, __VA_ARGS__)
#define RCLCPP_DEBUG_EXPRESSION(...) RCLCPP_LOG_EXPRESSION_(TEXT, DEBUG, __VA_ARGS__)
#define RCLCPP_DEBUG_FUNCTION(...) RCLCPP_LOG_FUNCTION_(TEXT, DEBUG, __VA_ARGS__)
#define RCLCPP_DEBUG_SKIPFIRST(...) RCLCPP_LOG_SKIPFIRST_(TEXT, DEBUG, __VA_ARGS__)
#define RCLCPP_DEBUG_THROTTLE(...) RCLCPP_LOG_THROTTLE_(TEXT, DEBUG, __VA_ARGS__)
#define RCLCPP_DEBUG_SKIPFIRST_THROTTLE(...) RCLCPP_LOG_SKIPFIRST_THROTTLE_(TEXT, DEBUG, __VA_ARGS__)
#define RCLCPP_DEBUG_STREAM(...) RCLCPP_LOG_ALWAYS_(STREAM, DEBUG, __VA_ARGS__)
#define RCLCPP_DEBUG_STREAM_ONCE(...) RCLCPP_LOG_ONCE_(STREAM, DEBUG, __VA_ARGS__)
#define RCLCPP_DEBUG_STREAM_EXPRESSION(...) RCLCPP_LOG_EXPRESSION_(STREAM, DEBUG, __VA_ARGS__)
#define RCLCPP_DEBUG_STREAM_FUNCTION(...) RCLCPP_LOG_FUNCTION_(STREAM, DEBUG, __VA_ARGS__)
#define RCLCPP_DEBUG_STREAM_SKIPFIRST(...) RCLCPP_LOG_SKIPFIRST_(STREAM, DEBUG, __VA_ARGS__)
#define RCLCPP_DEBUG_STREAM_THROTTLE(...) RCLCPP_LOG_THROTTLE_(STREAM, DEBUG, __VA_ARGS__)
#define RCLCPP_DEBUG_STREAM_SKIPFIRST_THROTTLE(...) RCLCPP_LOG_SKIPFIRST_THROTTLE_(STREAM, DEBUG, __VA_ARGS__)

#define RCLCPP_INFO(...) RCLCPP_LOG_ALWAYS_(TEXT, INFO, __VA_ARGS__)
#define RCLCPP_INFO_ONCE(...) RCLCPP_LOG_ONCE_(TEXT, INFO, __VA_ARGS__)
#define RCLCPP_INFO_EXPRESSION(...) RCLCPP_LOG_EXPRESSION_(TEXT, INFO, __VA_ARGS__)
#define RCLCPP_INFO_FUNCTION(...) RCLCPP_LOG_FUNCTION_(TEXT, INFO, __VA_ARGS__)
#define RCLCPP_INFO_SKIPFIRST(...) RCLCPP_LOG_SKIPFIRST_(TEXT, INFO, __VA_ARGS__)
#define RCLCPP_INFO_THROTTLE(...) RCLCPP_LOG_THROTTLE_(TEXT, INFO, __VA_ARGS__)
#define RCLCPP_INFO_SKIPFIRST_THROTTLE(...) RCLCPP_LOG_SKIPFIRST_THROTTLE_(TEXT, INFO, __VA_ARGS__)
#define RCLCPP_INFO_STREAM(...) RCLCPP_LOG_ALWAYS_(STREAM, INFO, __VA_ARGS__)
#define RCLCPP_INFO_STREAM_ONCE(...) RCLCPP_LOG_ONCE_(STREAM, INFO, __VA_ARGS__)
#define RCLCPP_INFO_STREAM_EXPRESSION(...) RCLCPP_LOG_EXPRESSION_(STREAM, INFO, __VA_ARGS__)
#define RCLCPP_INFO_STREAM_FUNCTION(...) RCLCPP_LOG_FUNCTION_(STREAM, INFO, __VA_ARGS__)
#define RCLCPP_INFO_STREAM_SKIPFIRST(...) RCLCPP_LOG_SKIPFIRST_(STREAM, INFO, __VA_ARGS__)
#define RCLCPP_INFO_STREAM_THROTTLE(...) RCLCPP_LOG_THROTTLE_(STREAM, INFO, __VA_ARGS__)
#define RCLCPP_INFO_STREAM_SKIPFIRST_THROTTLE(...) RCLCPP_LOG_SKIPFIRST_THROTTLE_(STREAM, INFO, __VA_ARGS__)

#define RCLCPP_WARN(...) RCLCPP_LOG_ALWAYS_(TEXT, WARN, __VA_ARGS__)
#define RCLCPP_WARN_ONCE(...) RCLCPP_LOG_ONCE_(TEXT, WARN, __VA_ARGS__)
#define RCLCPP_WARN_EXPRESSION(...) RCLCPP_LOG_EXPRESSION_(TEXT, WARN, __VA_ARGS__)
#define RCLCPP_WARN_FUNCTION(...) RCLCPP_LOG_FUNCTION_(TEXT, WARN, __VA_ARGS__)
#define RCLCPP_WARN_SKIPFIRST(...) RCLCPP_LOG_SKIPFIRST_(TEXT, WARN, __VA_ARGS__)
#define RCLCPP_WARN_THROTTLE(...) RCLCPP_LOG_THROTTLE_(TEXT, WARN, __VA_ARGS__)
#define RCLCPP_WARN_SKIPFIRST_THROTTLE(...) RCLCPP_LOG_SKIPFIRST_THROTTLE_(TEXT, WARN, __VA_ARGS__)
#define RCLCPP_WARN_STREAM(...) RCLCPP_LOG_ALWAYS_(STREAM, WARN, __VA_ARGS__)
#define RCLCPP_WARN_STREAM_ONCE(...) RCLCPP_LOG_ONCE_(STREAM, WARN, __VA_ARGS__)
#define RCLCPP_WARN_STREAM_EXPRESSION(...) RCLCPP_LOG_EXPRESSION_(STREAM, WARN, __VA_ARGS__)
#define RCLCPP_WARN_STREAM_FUNCTION(...) RCLCPP_LOG_FUNCTION_(STREAM, WARN, __VA_ARGS__)
#define RCLCPP_WARN_STREAM_SKIPFIRST(...) RCLCPP_LOG_SKIPFIRST_(STREAM, WARN, __VA_ARGS__)
#define RCLCPP_WARN_STREAM_THROTTLE(...) RCLCPP_LOG_THROTTLE_(STREAM, WARN, __VA_ARGS__)
#define RCLCPP_WARN_STREAM_SKIPFIRST_THROTTLE(...) RCLCPP_LOG_SKIPFIRST_THROTTLE_(STREAM, WARN, __VA_ARGS__)

#define RCLCPP_ERROR(...) RCLCPP_LOG_ALWAYS_(TEXT, ERROR, __VA_ARGS__)
#define RCLCPP_ERROR_ONCE(...) RCLCPP_LOG_ONCE_(TEXT, ERROR, __VA_ARGS__)
#define RCLCPP_ERROR_EXPRESSION(...) RCLCPP_LOG_EXPRESSION_(TEXT, ERROR, __VA_ARGS__)
#define RCLCPP_ERROR_FUNCTION(...) RCLCPP_LOG_FUNCTION_(TEXT, ERROR, __VA_ARGS__)
#define RCLCPP_ERROR_SKIPFIRST(...) RCLCPP_LOG_SKIPFIRST_(TEXT, ERROR, __VA_ARGS__)
#define RCLCPP_ERROR_THROTTLE(...) RCLCPP_LOG_THROTTLE_(TEXT, ERROR, __VA_ARGS__)
#define RCLCPP_ERROR_SKIPFIRST_THROTTLE(...) RCLCPP_LOG_SKIPFIRST_THROTTLE_(TEXT, ERROR, __VA_ARGS__)
#define RCLCPP_ERROR_STREAM(...) RCLCPP_LOG_ALWAYS_(STREAM, ERROR, __VA_ARGS__)
#define RCLCPP_ERROR_STREAM_ONCE(...) RCLCPP_LOG_ONCE_(STREAM, ERROR, __VA_ARGS__)
#define RCLCPP_ERROR_STREAM_EXPRESSION(...) RCLCPP_LOG_EXPRESSION_(STREAM, ERROR, __VA_ARGS__)
#define RCLCPP_ERROR_STREAM_FUNCTION(...) RCLCPP_LOG_FUNCTION_(STREAM, ERROR, __VA_ARGS__)
#define RCLCPP_ERROR_STREAM_SKIPFIRST(...) RCLCPP_LOG_SKIPFIRST_(STREAM, ERROR, __VA_ARGS__)
#define RCLCPP_ERROR_STREAM_THROTTLE(...) RCLCPP_LOG_THROTTLE_(STREAM, ERROR, __VA_ARGS__)
#define RCLCPP_ERROR_STREAM_SKIPFIRST_THROTTLE(...) RCLCPP_LOG_SKIPFIRST_THROTTLE_(STREAM, ERROR, __VA_ARGS__)

#define RCLCPP_FATAL(...) RCLCPP_LOG_ALWAYS_(TEXT, FATAL, __VA_ARGS__)
#define RCLCPP_FATAL_ONCE(...) RCLCPP_LOG_ONCE_(TEXT, FATAL, __VA_ARGS__)
#define RCLCPP_FATAL_EXPRESSION(...) RCLCPP_LOG_EXPRESSION_(TEXT, FATAL, __VA_ARGS__)
#define RCLCPP_FATAL_FUNCTION(...) RCLCPP_LOG_FUNCTION_(TEXT, FATAL, __VA_ARGS__)
#define RCLCPP_FATAL_SKIPFIRST(...) RCLCPP_LOG_SKIPFIRST_(TEXT, FATAL, __VA_ARGS__)
#define RCLCPP_FATAL_THROTTLE(...) RCLCPP_LOG_THROTTLE_(TEXT, FATAL, __VA_ARGS__)
#define RCLCPP_FATAL_SKIPFIRST_THROTTLE(...) RCLCPP_LOG_SKIPFIRST_THROTTLE_(TEXT, FATAL, __VA_ARGS__)
#define RCLCPP_FATAL_STREAM(...) RCLCPP_LOG_ALWAYS_(STREAM, FATAL, __VA_ARGS__)
#define RCLCPP_FATAL_STREAM_ONCE(...) RCLCPP_LOG_ONCE_(STREAM, FATAL, __VA_ARGS__)
#define RCLCPP_FATAL_STREAM_EXPRESSION(...) RCLCPP_LOG_EXPRESSION_(STREAM, FATAL, __VA_ARGS__)
#define RCLCPP_FATAL_STREAM_FUNCTION(...) RCLCPP_LOG_FUNCTION_(STREAM, FATAL, __VA_ARGS__)
#define RCLCPP_FATAL_STREAM_SKIPFIRST(...) RCLCPP_LOG_SKIPFIRST_(STREAM, FATAL, __VA_ARGS__)
#define RCLCPP_FATAL_STREAM_THROTTLE(...) RCLCPP_LOG_THROTTLE_(STREAM, FATAL, __VA_ARGS__)
#define RCLCPP_FATAL_STREAM_SKIPFIRST_THROTTLE(...) RCLCPP_LOG_SKIPFIRST_THROTTLE_(STREAM, FATAL, __VA_ARGS__)
