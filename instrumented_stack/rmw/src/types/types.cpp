// SPDX-License-Identifier: Apache-2.0
// Initial values of the plain types, and arithmetic of rmw_time_t.
#include "rmw/types.h"

#include <cstdint>
#include <limits>

#include "rmw/discovery_options.h"
#include "rmw/error_handling.h"
#include "rmw/names_and_types.h"
#include "rmw/rmw.h"

namespace {

constexpr rmw_time_t kInfinite = RMW_DURATION_INFINITE;
constexpr uint64_t kNanosecondsPerSecond = 1000000000;

}  // namespace

bool rmw_time_equal(const rmw_time_t left, const rmw_time_t right) {
  return rmw_time_total_nsec(left) == rmw_time_total_nsec(right);
}

rmw_duration_t rmw_time_total_nsec(const rmw_time_t time) {
  constexpr uint64_t kMax = std::numeric_limits<rmw_duration_t>::max();
  if (time.sec > kMax / kNanosecondsPerSecond || time.nsec > kMax - time.sec * kNanosecondsPerSecond) {
    return std::numeric_limits<rmw_duration_t>::max();
  }
  return static_cast<rmw_duration_t>(time.sec * kNanosecondsPerSecond + time.nsec);
}

rmw_time_t rmw_time_from_nsec(const rmw_duration_t nanoseconds) {
  if (nanoseconds < 0) {
    return kInfinite;
  }
  const uint64_t total = static_cast<uint64_t>(nanoseconds);
  return {total / kNanosecondsPerSecond, total % kNanosecondsPerSecond};
}

[[gnu::hot]] rmw_message_info_t rmw_get_zero_initialized_message_info(void) {
  return {};
}

rmw_discovery_options_t rmw_get_zero_initialized_discovery_options(void) {
  return {};
}

rmw_publisher_options_t rmw_get_default_publisher_options(void) {
  return {};
}

rmw_subscription_options_t rmw_get_default_subscription_options(void) {
  return {};
}

rmw_names_and_types_t rmw_get_zero_initialized_names_and_types(void) {
  return {};
}

rmw_ret_t rmw_names_and_types_init(rmw_names_and_types_t* names_and_types, size_t size,
                                   rcutils_allocator_t* allocator) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(names_and_types, RMW_RET_INVALID_ARGUMENT);
  *names_and_types = {};
  if (rcutils_string_array_init(&names_and_types->names, size, allocator) != RCUTILS_RET_OK) {
    return RMW_RET_ERROR;
  }
  if (size != 0) {
    names_and_types->types = static_cast<rcutils_string_array_t*>(
        allocator->zero_allocate(size, sizeof(rcutils_string_array_t), allocator->state));
    if (names_and_types->types == nullptr) {
      (void)rcutils_string_array_fini(&names_and_types->names);
      RMW_SET_ERROR_MSG("out of memory for topic types");
      return RMW_RET_BAD_ALLOC;
    }
  }
  return RMW_RET_OK;
}

rmw_ret_t rmw_names_and_types_fini(rmw_names_and_types_t* names_and_types) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(names_and_types, RMW_RET_INVALID_ARGUMENT);
  if (names_and_types->types != nullptr) {
    const rcutils_allocator_t allocator = names_and_types->names.allocator;
    for (size_t i = 0; i < names_and_types->names.size; ++i) {
      (void)rcutils_string_array_fini(&names_and_types->types[i]);
    }
    allocator.deallocate(names_and_types->types, allocator.state);
    names_and_types->types = nullptr;
  }
  return rcutils_string_array_fini(&names_and_types->names) == RCUTILS_RET_OK ? RMW_RET_OK : RMW_RET_ERROR;
}
