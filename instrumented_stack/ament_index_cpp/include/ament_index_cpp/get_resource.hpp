// SPDX-License-Identifier: Apache-2.0
// The content of a resource: the file share/ament_index/resource_index/TYPE/NAME.
#pragma once

#include <string>

namespace ament_index_cpp {

// The first one in the order of get_search_paths(). False, and nothing changed, if there is none. Throws
// std::runtime_error for an empty type or name, and when the file cannot be read.
bool get_resource(const std::string& resource_type, const std::string& resource_name, std::string& content,
                  std::string* prefix_path = nullptr);

}  // namespace ament_index_cpp
