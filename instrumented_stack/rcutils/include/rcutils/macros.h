// SPDX-License-Identifier: Apache-2.0
// Hints for compilers.
#pragma once

#define RCUTILS_WARN_UNUSED __attribute__((warn_unused_result))
#define RCUTILS_LIKELY(expression) __builtin_expect((expression), 1)
#define RCUTILS_UNLIKELY(expression) __builtin_expect((expression), 0)
#define RCUTILS_UNUSED(argument) (void)(argument)
#define RCUTILS_STRINGIFY_IMPL(text) #text
#define RCUTILS_STRINGIFY(text) RCUTILS_STRINGIFY_IMPL(text)
#define RCUTILS_THREAD_LOCAL __thread
