// SPDX-License-Identifier: Apache-2.0
// Strings that the C interface returns.
#pragma once

#include <cstring>
#include <string_view>

#include "rcl/allocator.h"
#include "rcl/error_handling.h"
#include "rcl/types.h"

namespace rcl {

// Allocates a copy, which the caller frees. Returns RCL_RET_BAD_ALLOC if memory runs out.
inline rcl_ret_t hand_out(std::string_view text, const rcl_allocator_t& allocator, char** output) {
  char* copy = static_cast<char*>(allocator.allocate(text.size() + 1, allocator.state));
  if (copy == nullptr) {
    RCL_SET_ERROR_MSG("out of memory for a name");
    return RCL_RET_BAD_ALLOC;
  }
  std::memcpy(copy, text.data(), text.size());
  copy[text.size()] = '\0';
  *output = copy;
  return RCL_RET_OK;
}

}  // namespace rcl
