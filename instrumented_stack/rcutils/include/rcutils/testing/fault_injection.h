// SPDX-License-Identifier: Apache-2.0
// Lets the functions of a library fail one after the other, for tests of what comes after a failure.
//
// The macros work in libraries that are compiled with RCUTILS_ENABLE_FAULT_INJECTION. The libraries of this stack have
// no such places, so RCUTILS_FAULT_INJECTION_TEST runs its code once with them.
#pragma once

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "rcutils/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

#define RCUTILS_FAULT_INJECTION_NEVER_FAIL -1
#define RCUTILS_FAULT_INJECTION_FAIL_NOW 0

bool rcutils_fault_injection_is_test_complete(void);

// The place that fails is the one with this number, counted from 0.
void rcutils_fault_injection_set_count(int_least64_t count);
int_least64_t rcutils_fault_injection_get_count(void);

// The count before it goes down by one.
int_least64_t _rcutils_fault_injection_maybe_fail(void);

#define RCUTILS_FAULT_INJECTION_MAYBE_FAIL(failure_code)                           \
  if (_rcutils_fault_injection_maybe_fail() == RCUTILS_FAULT_INJECTION_FAIL_NOW) { \
    printf("%s:%d fault injected: %s\n", __FILE__, __LINE__, #failure_code);       \
    failure_code;                                                                  \
  }

#define RCUTILS_FAULT_INJECTION_MAYBE_RETURN_ERROR(return_value_on_error) \
  RCUTILS_FAULT_INJECTION_MAYBE_FAIL(return return_value_on_error)

#define RCUTILS_FAULT_INJECTION_TEST(code)                                 \
  do {                                                                     \
    int fault_injection_count = 0;                                         \
    do {                                                                   \
      rcutils_fault_injection_set_count(fault_injection_count++);          \
      code;                                                                \
    } while (!rcutils_fault_injection_is_test_complete());                 \
    rcutils_fault_injection_set_count(RCUTILS_FAULT_INJECTION_NEVER_FAIL); \
  } while (0)

#define RCUTILS_NO_FAULT_INJECTION(code)                                                \
  do {                                                                                  \
    const int_least64_t no_fault_injection_count = rcutils_fault_injection_get_count(); \
    rcutils_fault_injection_set_count(RCUTILS_FAULT_INJECTION_NEVER_FAIL);              \
    code;                                                                               \
    rcutils_fault_injection_set_count(no_fault_injection_count);                        \
  } while (0)

#ifdef __cplusplus
}
#endif
