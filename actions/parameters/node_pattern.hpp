// SPDX-License-Identifier: Apache-2.0
// The names of nodes in parameter files, which may be patterns: * stands for one part of a name, ** for any number.
#pragma once

#include <string_view>

namespace launch {

bool is_valid_node_pattern(std::string_view pattern);

// Whether the pattern is for this full name. Slashes at the beginning do not count.
bool is_for_node(std::string_view pattern, std::string_view full_name);
// Whether the pattern is for some node in this namespace.
bool is_for_namespace(std::string_view pattern, std::string_view name_space);

}  // namespace launch
