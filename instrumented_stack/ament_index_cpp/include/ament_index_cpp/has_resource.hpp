// SPDX-License-Identifier: Apache-2.0
// Whether a resource exists.
#pragma once

#include <string>

namespace ament_index_cpp {

// `prefix_path` gets the first prefix, in the order of get_search_paths(), that has it. Throws std::runtime_error for
// an empty type or name.
bool has_resource(const std::string& resource_type, const std::string& resource_name,
                  std::string* prefix_path = nullptr);

}  // namespace ament_index_cpp
