// SPDX-License-Identifier: Apache-2.0
// Names of topics and services: expansion and checks, as values and exceptions; and strings that the C interface
// returns.
#pragma once

#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>

#include "rcl/allocator.h"
#include "rcl/error_handling.h"
#include "rcl/types.h"
#include "rcutils/types/string_map.h"

namespace rcl {

// An invalid name, with the code that the C interface returns for it.
class NameError : public std::invalid_argument {
 public:
  NameError(rcl_ret_t code, const std::string& message) : std::invalid_argument(message), code_(code) {}
  rcl_ret_t code() const { return code_; }

 private:
  rcl_ret_t code_;
};

// Expands the name but does not check the result. `substitutions` may be null. Throws NameError.
std::string expand_topic_name(std::string_view name, std::string_view node_name, std::string_view node_namespace,
                              const rcutils_string_map_t* substitutions = nullptr);

// Throws NameError unless `name` is a full topic name.
void check_full_topic_name(const std::string& name);

// Throws NameError unless both are valid.
void check_node_names(const std::string& name, const std::string& node_namespace);

// `/node` or `/ns/node`
std::string fully_qualified_name(std::string_view node_namespace, std::string_view node_name);

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
