// SPDX-License-Identifier: Apache-2.0
// All resources of a type.
#pragma once

#include <map>
#include <string>

namespace ament_index_cpp {

// Each name with the first prefix, in the order of get_search_paths(), that has it. Throws std::runtime_error for an
// empty type.
std::map<std::string, std::string> get_resources(const std::string& resource_type);

}  // namespace ament_index_cpp
