// SPDX-License-Identifier: Apache-2.0
// Names of nodes in parameter files.
#pragma once

#include <string>

namespace rcl_yaml {

// What is wrong with the name of a node, which may have `*` and `**` in place of whole levels; empty if nothing is.
std::string wrong_in_node_pattern(const std::string& pattern);

}  // namespace rcl_yaml
