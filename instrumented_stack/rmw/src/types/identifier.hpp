// SPDX-License-Identifier: Apache-2.0
// Marks the handles that this implementation made. It is compared by address.
#pragma once

namespace rmw_fastrtps {

extern const char* const kIdentifier;

}  // namespace rmw_fastrtps

// Leaves a message and returns from the calling function if a handle is null or belongs to another implementation.
#define RMW_CHECK_HANDLE(handle, error_return)                                         \
  do {                                                                                 \
    if ((handle) == nullptr) {                                                         \
      RMW_SET_ERROR_MSG(#handle " argument is null");                                  \
      return error_return;                                                             \
    }                                                                                  \
    if ((handle)->implementation_identifier != rmw_fastrtps::kIdentifier) {            \
      RMW_SET_ERROR_MSG(#handle " was not created by this middleware implementation"); \
      return error_return;                                                             \
    }                                                                                  \
  } while (0)
