// SPDX-License-Identifier: Apache-2.0
#include "rcutils/testing/fault_injection.h"

#include <atomic>

namespace {

std::atomic<int_least64_t> places_before_failure{RCUTILS_FAULT_INJECTION_NEVER_FAIL};

}  // namespace

// No library of this stack has places that fail, so a test is complete after its first run.
bool rcutils_fault_injection_is_test_complete(void) {
  return true;
}

void rcutils_fault_injection_set_count(int_least64_t count) {
  places_before_failure = count;
}

int_least64_t rcutils_fault_injection_get_count(void) {
  return places_before_failure;
}

int_least64_t _rcutils_fault_injection_maybe_fail(void) {
  int_least64_t count = places_before_failure;
  while (count > RCUTILS_FAULT_INJECTION_NEVER_FAIL && !places_before_failure.compare_exchange_weak(count, count - 1)) {
  }
  return count;
}
