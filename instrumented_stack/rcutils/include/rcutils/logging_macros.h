// SPDX-License-Identifier: Apache-2.0
// RCUTILS_LOG_{DEBUG,INFO,WARN,ERROR,FATAL}: write one log line, like printf, from C or C++.
//
//   RCUTILS_LOG_INFO("got %d", 3);
//   RCUTILS_LOG_INFO_NAMED("my_logger", "got %d", 3);
//
// Each also exists with a condition. Level and condition together decide whether the line is written and its arguments
// are evaluated:
//   _ONCE(…)                           the first time only
//   _EXPRESSION(expression, …)         if the expression is true
//   _FUNCTION(function, …)             if function() is true
//   _SKIPFIRST(…)                      from the second time on
//   _THROTTLE(time_function, duration_ms, …)   if duration_ms have passed since the last line; time_function is
//   rcutils_steady_time_now or a similar function
//   _SKIPFIRST_THROTTLE(time_function, duration_ms, …)
// Each of these also exists with _NAMED, which takes the name of the logger before the format. Conditions with a memory
// have one for each place in the source, and only count lines that the level lets pass. The memory is not synchronised:
// a race can lose or double a line.
#pragma once

#include "rcutils/logging.h"
#include "rcutils/time.h"

// `before` declares the memory. `condition` is evaluated if the level lets the line pass.
#define RCUTILS_LOG_IF_(severity, before, condition, name, ...)                           \
  do {                                                                                    \
    static rcutils_log_location_t rcutils_log_location_ = {__func__, __FILE__, __LINE__}; \
    before RCUTILS_LOGGING_AUTOINIT;                                                      \
    if (rcutils_logging_logger_is_enabled_for(name, severity) && (condition)) {           \
      rcutils_log_internal(&rcutils_log_location_, severity, name, __VA_ARGS__);          \
    }                                                                                     \
  } while (0)

#define RCUTILS_LOG_ONCE_BEFORE_ static int rcutils_log_count_ = 0;
#define RCUTILS_LOG_ONCE_CONDITION_ (rcutils_log_count_ == 0 && ++rcutils_log_count_)
#define RCUTILS_LOG_SKIPFIRST_CONDITION_ (rcutils_log_count_ != 0 || !++rcutils_log_count_)
#define RCUTILS_LOG_THROTTLE_BEFORE_            \
  static int rcutils_log_throttle_started_ = 0; \
  static rcutils_time_point_value_t rcutils_log_throttle_last_ = 0;

#ifdef __cplusplus
extern "C" {
#endif

// Whether a throttled line is due. It is due if the clock cannot be read or has jumped back.
static inline bool rcutils_log_throttle_due_(rcutils_ret_t (*time_function)(rcutils_time_point_value_t*),
                                             double duration_ms, int* started, rcutils_time_point_value_t* last) {
  rcutils_time_point_value_t now = 0;
  if (time_function(&now) == RCUTILS_RET_OK && *started && now >= *last && (double)(now - *last) < duration_ms * 1e6) {
    return false;
  }
  *started = 1;
  *last = now;
  return true;
}

#ifdef __cplusplus
}
#endif

#define RCUTILS_LOG_THROTTLE_CONDITION_(time_function, duration) \
  rcutils_log_throttle_due_(time_function, duration, &rcutils_log_throttle_started_, &rcutils_log_throttle_last_)

// The conditions. The level is joined to a name before it could be replaced, in case a program defines a macro DEBUG or
// ERROR.
#define RCUTILS_LOG_ALWAYS_(level, name, ...) RCUTILS_LOG_IF_(RCUTILS_LOG_SEVERITY_##level, , 1, name, __VA_ARGS__)
#define RCUTILS_LOG_ONCE_(level, name, ...)                                                                  \
  RCUTILS_LOG_IF_(RCUTILS_LOG_SEVERITY_##level, RCUTILS_LOG_ONCE_BEFORE_, RCUTILS_LOG_ONCE_CONDITION_, name, \
                  __VA_ARGS__)
#define RCUTILS_LOG_EXPRESSION_(level, expression, name, ...) \
  RCUTILS_LOG_IF_(RCUTILS_LOG_SEVERITY_##level, , expression, name, __VA_ARGS__)
#define RCUTILS_LOG_FUNCTION_(level, function, name, ...) \
  RCUTILS_LOG_IF_(RCUTILS_LOG_SEVERITY_##level, , (*function)(), name, __VA_ARGS__)
#define RCUTILS_LOG_SKIPFIRST_(level, name, ...)                                                                  \
  RCUTILS_LOG_IF_(RCUTILS_LOG_SEVERITY_##level, RCUTILS_LOG_ONCE_BEFORE_, RCUTILS_LOG_SKIPFIRST_CONDITION_, name, \
                  __VA_ARGS__)
#define RCUTILS_LOG_THROTTLE_(level, now, ms, name, ...)                      \
  RCUTILS_LOG_IF_(RCUTILS_LOG_SEVERITY_##level, RCUTILS_LOG_THROTTLE_BEFORE_, \
                  RCUTILS_LOG_THROTTLE_CONDITION_(now, ms), name, __VA_ARGS__)
#define RCUTILS_LOG_SKIPFIRST_THROTTLE_(level, now, ms, name, ...)                                     \
  RCUTILS_LOG_IF_(RCUTILS_LOG_SEVERITY_##level, RCUTILS_LOG_ONCE_BEFORE_ RCUTILS_LOG_THROTTLE_BEFORE_, \
                  RCUTILS_LOG_SKIPFIRST_CONDITION_&& RCUTILS_LOG_THROTTLE_CONDITION_(now, ms), name, __VA_ARGS__)

#define RCUTILS_LOG_DEBUG(...) RCUTILS_LOG_ALWAYS_(DEBUG, "", __VA_ARGS__)
#define RCUTILS_LOG_DEBUG_NAMED(...) RCUTILS_LOG_ALWAYS_(DEBUG, __VA_ARGS__)
#define RCUTILS_LOG_DEBUG_ONCE(...) RCUTILS_LOG_ONCE_(DEBUG, "", __VA_ARGS__)
#define RCUTILS_LOG_DEBUG_ONCE_NAMED(...) RCUTILS_LOG_ONCE_(DEBUG, __VA_ARGS__)
#define RCUTILS_LOG_DEBUG_EXPRESSION(expression, ...) RCUTILS_LOG_EXPRESSION_(DEBUG, expression, "", __VA_ARGS__)
#define RCUTILS_LOG_DEBUG_EXPRESSION_NAMED(...) RCUTILS_LOG_EXPRESSION_(DEBUG, __VA_ARGS__)
#define RCUTILS_LOG_DEBUG_FUNCTION(function, ...) RCUTILS_LOG_FUNCTION_(DEBUG, function, "", __VA_ARGS__)
#define RCUTILS_LOG_DEBUG_FUNCTION_NAMED(...) RCUTILS_LOG_FUNCTION_(DEBUG, __VA_ARGS__)
#define RCUTILS_LOG_DEBUG_SKIPFIRST(...) RCUTILS_LOG_SKIPFIRST_(DEBUG, "", __VA_ARGS__)
#define RCUTILS_LOG_DEBUG_SKIPFIRST_NAMED(...) RCUTILS_LOG_SKIPFIRST_(DEBUG, __VA_ARGS__)
#define RCUTILS_LOG_DEBUG_THROTTLE(now, ms, ...) RCUTILS_LOG_THROTTLE_(DEBUG, now, ms, "", __VA_ARGS__)
#define RCUTILS_LOG_DEBUG_THROTTLE_NAMED(...) RCUTILS_LOG_THROTTLE_(DEBUG, __VA_ARGS__)
#define RCUTILS_LOG_DEBUG_SKIPFIRST_THROTTLE(now, ms, ...) \
  RCUTILS_LOG_SKIPFIRST_THROTTLE_(DEBUG, now, ms, "", __VA_ARGS__)
#define RCUTILS_LOG_DEBUG_SKIPFIRST_THROTTLE_NAMED(...) RCUTILS_LOG_SKIPFIRST_THROTTLE_(DEBUG, __VA_ARGS__)

#define RCUTILS_LOG_INFO(...) RCUTILS_LOG_ALWAYS_(INFO, "", __VA_ARGS__)
#define RCUTILS_LOG_INFO_NAMED(...) RCUTILS_LOG_ALWAYS_(INFO, __VA_ARGS__)
#define RCUTILS_LOG_INFO_ONCE(...) RCUTILS_LOG_ONCE_(INFO, "", __VA_ARGS__)
#define RCUTILS_LOG_INFO_ONCE_NAMED(...) RCUTILS_LOG_ONCE_(INFO, __VA_ARGS__)
#define RCUTILS_LOG_INFO_EXPRESSION(expression, ...) RCUTILS_LOG_EXPRESSION_(INFO, expression, "", __VA_ARGS__)
#define RCUTILS_LOG_INFO_EXPRESSION_NAMED(...) RCUTILS_LOG_EXPRESSION_(INFO, __VA_ARGS__)
#define RCUTILS_LOG_INFO_FUNCTION(function, ...) RCUTILS_LOG_FUNCTION_(INFO, function, "", __VA_ARGS__)
#define RCUTILS_LOG_INFO_FUNCTION_NAMED(...) RCUTILS_LOG_FUNCTION_(INFO, __VA_ARGS__)
#define RCUTILS_LOG_INFO_SKIPFIRST(...) RCUTILS_LOG_SKIPFIRST_(INFO, "", __VA_ARGS__)
#define RCUTILS_LOG_INFO_SKIPFIRST_NAMED(...) RCUTILS_LOG_SKIPFIRST_(INFO, __VA_ARGS__)
#define RCUTILS_LOG_INFO_THROTTLE(now, ms, ...) RCUTILS_LOG_THROTTLE_(INFO, now, ms, "", __VA_ARGS__)
#define RCUTILS_LOG_INFO_THROTTLE_NAMED(...) RCUTILS_LOG_THROTTLE_(INFO, __VA_ARGS__)
#define RCUTILS_LOG_INFO_SKIPFIRST_THROTTLE(now, ms, ...) \
  RCUTILS_LOG_SKIPFIRST_THROTTLE_(INFO, now, ms, "", __VA_ARGS__)
#define RCUTILS_LOG_INFO_SKIPFIRST_THROTTLE_NAMED(...) RCUTILS_LOG_SKIPFIRST_THROTTLE_(INFO, __VA_ARGS__)

#define RCUTILS_LOG_WARN(...) RCUTILS_LOG_ALWAYS_(WARN, "", __VA_ARGS__)
#define RCUTILS_LOG_WARN_NAMED(...) RCUTILS_LOG_ALWAYS_(WARN, __VA_ARGS__)
#define RCUTILS_LOG_WARN_ONCE(...) RCUTILS_LOG_ONCE_(WARN, "", __VA_ARGS__)
#define RCUTILS_LOG_WARN_ONCE_NAMED(...) RCUTILS_LOG_ONCE_(WARN, __VA_ARGS__)
#define RCUTILS_LOG_WARN_EXPRESSION(expression, ...) RCUTILS_LOG_EXPRESSION_(WARN, expression, "", __VA_ARGS__)
#define RCUTILS_LOG_WARN_EXPRESSION_NAMED(...) RCUTILS_LOG_EXPRESSION_(WARN, __VA_ARGS__)
#define RCUTILS_LOG_WARN_FUNCTION(function, ...) RCUTILS_LOG_FUNCTION_(WARN, function, "", __VA_ARGS__)
#define RCUTILS_LOG_WARN_FUNCTION_NAMED(...) RCUTILS_LOG_FUNCTION_(WARN, __VA_ARGS__)
#define RCUTILS_LOG_WARN_SKIPFIRST(...) RCUTILS_LOG_SKIPFIRST_(WARN, "", __VA_ARGS__)
#define RCUTILS_LOG_WARN_SKIPFIRST_NAMED(...) RCUTILS_LOG_SKIPFIRST_(WARN, __VA_ARGS__)
#define RCUTILS_LOG_WARN_THROTTLE(now, ms, ...) RCUTILS_LOG_THROTTLE_(WARN, now, ms, "", __VA_ARGS__)
#define RCUTILS_LOG_WARN_THROTTLE_NAMED(...) RCUTILS_LOG_THROTTLE_(WARN, __VA_ARGS__)
#define RCUTILS_LOG_WARN_SKIPFIRST_THROTTLE(now, ms, ...) \
  RCUTILS_LOG_SKIPFIRST_THROTTLE_(WARN, now, ms, "", __VA_ARGS__)
#define RCUTILS_LOG_WARN_SKIPFIRST_THROTTLE_NAMED(...) RCUTILS_LOG_SKIPFIRST_THROTTLE_(WARN, __VA_ARGS__)

#define RCUTILS_LOG_ERROR(...) RCUTILS_LOG_ALWAYS_(ERROR, "", __VA_ARGS__)
#define RCUTILS_LOG_ERROR_NAMED(...) RCUTILS_LOG_ALWAYS_(ERROR, __VA_ARGS__)
#define RCUTILS_LOG_ERROR_ONCE(...) RCUTILS_LOG_ONCE_(ERROR, "", __VA_ARGS__)
#define RCUTILS_LOG_ERROR_ONCE_NAMED(...) RCUTILS_LOG_ONCE_(ERROR, __VA_ARGS__)
#define RCUTILS_LOG_ERROR_EXPRESSION(expression, ...) RCUTILS_LOG_EXPRESSION_(ERROR, expression, "", __VA_ARGS__)
#define RCUTILS_LOG_ERROR_EXPRESSION_NAMED(...) RCUTILS_LOG_EXPRESSION_(ERROR, __VA_ARGS__)
#define RCUTILS_LOG_ERROR_FUNCTION(function, ...) RCUTILS_LOG_FUNCTION_(ERROR, function, "", __VA_ARGS__)
#define RCUTILS_LOG_ERROR_FUNCTION_NAMED(...) RCUTILS_LOG_FUNCTION_(ERROR, __VA_ARGS__)
#define RCUTILS_LOG_ERROR_SKIPFIRST(...) RCUTILS_LOG_SKIPFIRST_(ERROR, "", __VA_ARGS__)
#define RCUTILS_LOG_ERROR_SKIPFIRST_NAMED(...) RCUTILS_LOG_SKIPFIRST_(ERROR, __VA_ARGS__)
#define RCUTILS_LOG_ERROR_THROTTLE(now, ms, ...) RCUTILS_LOG_THROTTLE_(ERROR, now, ms, "", __VA_ARGS__)
#define RCUTILS_LOG_ERROR_THROTTLE_NAMED(...) RCUTILS_LOG_THROTTLE_(ERROR, __VA_ARGS__)
#define RCUTILS_LOG_ERROR_SKIPFIRST_THROTTLE(now, ms, ...) \
  RCUTILS_LOG_SKIPFIRST_THROTTLE_(ERROR, now, ms, "", __VA_ARGS__)
#define RCUTILS_LOG_ERROR_SKIPFIRST_THROTTLE_NAMED(...) RCUTILS_LOG_SKIPFIRST_THROTTLE_(ERROR, __VA_ARGS__)

#define RCUTILS_LOG_FATAL(...) RCUTILS_LOG_ALWAYS_(FATAL, "", __VA_ARGS__)
#define RCUTILS_LOG_FATAL_NAMED(...) RCUTILS_LOG_ALWAYS_(FATAL, __VA_ARGS__)
#define RCUTILS_LOG_FATAL_ONCE(...) RCUTILS_LOG_ONCE_(FATAL, "", __VA_ARGS__)
#define RCUTILS_LOG_FATAL_ONCE_NAMED(...) RCUTILS_LOG_ONCE_(FATAL, __VA_ARGS__)
#define RCUTILS_LOG_FATAL_EXPRESSION(expression, ...) RCUTILS_LOG_EXPRESSION_(FATAL, expression, "", __VA_ARGS__)
#define RCUTILS_LOG_FATAL_EXPRESSION_NAMED(...) RCUTILS_LOG_EXPRESSION_(FATAL, __VA_ARGS__)
#define RCUTILS_LOG_FATAL_FUNCTION(function, ...) RCUTILS_LOG_FUNCTION_(FATAL, function, "", __VA_ARGS__)
#define RCUTILS_LOG_FATAL_FUNCTION_NAMED(...) RCUTILS_LOG_FUNCTION_(FATAL, __VA_ARGS__)
#define RCUTILS_LOG_FATAL_SKIPFIRST(...) RCUTILS_LOG_SKIPFIRST_(FATAL, "", __VA_ARGS__)
#define RCUTILS_LOG_FATAL_SKIPFIRST_NAMED(...) RCUTILS_LOG_SKIPFIRST_(FATAL, __VA_ARGS__)
#define RCUTILS_LOG_FATAL_THROTTLE(now, ms, ...) RCUTILS_LOG_THROTTLE_(FATAL, now, ms, "", __VA_ARGS__)
#define RCUTILS_LOG_FATAL_THROTTLE_NAMED(...) RCUTILS_LOG_THROTTLE_(FATAL, __VA_ARGS__)
#define RCUTILS_LOG_FATAL_SKIPFIRST_THROTTLE(now, ms, ...) \
  RCUTILS_LOG_SKIPFIRST_THROTTLE_(FATAL, now, ms, "", __VA_ARGS__)
#define RCUTILS_LOG_FATAL_SKIPFIRST_THROTTLE_NAMED(...) RCUTILS_LOG_SKIPFIRST_THROTTLE_(FATAL, __VA_ARGS__)

// The clocks for _THROTTLE.
#define RCUTILS_STEADY_TIME rcutils_steady_time_now
#define RCUTILS_SYSTEM_TIME rcutils_system_time_now
