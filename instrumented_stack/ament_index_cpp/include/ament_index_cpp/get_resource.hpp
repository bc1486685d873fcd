// SPDX-License-Identifier: Apache-2.0
// The content of a resource: the file share/ament_index/resource_index/TYPE/NAME.
#pragma once

#include <string>

namespace ament_index_cpp {

// Reads the first one in the order of get_search_paths(). Returns false and changes nothing if there is none. Throws
// std::runtime_error for an empty type or name, and if the file cannot be read.
bool get_resource(const std::string& resource_type, const std::string& resource_name, std::string& content,
                  std::string* prefix_path = nullptr);

}  // namespace ament_index_cpp
