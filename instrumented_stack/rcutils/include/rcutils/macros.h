// SPDX-License-Identifier: Apache-2.0
// Hints for compilers.
#pragma once

#define RCUTILS_WARN_UNUSED __attribute__((warn_unused_result))
#define RCUTILS_LIKELY(expression) __builtin_expect((expression), 1)
#define RCUTILS_UNLIKELY(expression) __builtin_expect((expression), 0)
#define RCUTILS_UNUSED(argument) (void)(argument)
#define RCUTILS_EXPAND(text) text
#define RCUTILS_STRINGIFY_IMPL(text) #text
#define RCUTILS_STRINGIFY(text) RCUTILS_STRINGIFY_IMPL(text)
#define RCUTILS_JOIN_IMPL(left, right) left##right
#define RCUTILS_JOIN(left, right) RCUTILS_JOIN_IMPL(left, right)
#define RCUTILS_THREAD_LOCAL __thread
#define RCUTILS_ATTRIBUTE_PRINTF_FORMAT(format_index, first_argument_index) \
  __attribute__((format(printf, format_index, first_argument_index)))
#define RCUTILS_DEPRECATED __attribute__((deprecated))
#define RCUTILS_DEPRECATED_WITH_MSG(message) __attribute__((deprecated(message)))
#define RCUTILS_NONNULL __attribute__((__nonnull__))
#define RCUTILS_NONNULL_ARGS(...) __attribute__((__nonnull__(__VA_ARGS__)))
#define RCUTILS_RETURNS_NONNULL __attribute__((__returns_nonnull__))
#define RCUTILS_HAS_NONNULL 1

// Places where a test may inject a fault (rcutils/testing/fault_injection.h).
#if defined(RCUTILS_ENABLE_FAULT_INJECTION)
#include "rcutils/testing/fault_injection.h"
#define RCUTILS_CAN_RETURN_WITH_ERROR_OF(error_return_value) \
  RCUTILS_FAULT_INJECTION_MAYBE_RETURN_ERROR(error_return_value)
#define RCUTILS_CAN_FAIL_WITH(failure_code) RCUTILS_FAULT_INJECTION_MAYBE_FAIL(failure_code)
#else
#define RCUTILS_CAN_RETURN_WITH_ERROR_OF(error_return_value)
#define RCUTILS_CAN_FAIL_WITH(failure_code)
#endif
