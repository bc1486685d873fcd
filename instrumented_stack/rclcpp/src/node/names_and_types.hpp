// SPDX-License-Identifier: Apache-2.0
// Converts rcl's names and types of the graph to C++.
#pragma once

#include <rcl/graph.h>

#include <map>
#include <string>
#include <vector>

#include "rclcpp/detail/require_ok.hpp"

namespace rclcpp::detail {

// Also frees `names`.
inline std::map<std::string, std::vector<std::string>> to_map(rcl_names_and_types_t& names_and_types) {
  std::map<std::string, std::vector<std::string>> result;
  for (size_t i = 0; i < names_and_types.names.size; ++i) {
    const rcutils_string_array_t& types = names_and_types.types[i];
    result[names_and_types.names.data[i]] = std::vector<std::string>(types.data, types.data + types.size);
  }
  require_ok(rcl_names_and_types_fini(&names_and_types), "failed to free names and types");
  return result;
}

}  // namespace rclcpp::detail
