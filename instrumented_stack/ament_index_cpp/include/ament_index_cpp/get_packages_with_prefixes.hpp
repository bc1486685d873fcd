// SPDX-License-Identifier: Apache-2.0
// All packages that can be found.
#pragma once

#include <map>
#include <string>

namespace ament_index_cpp {

std::map<std::string, std::string> get_packages_with_prefixes();

}  // namespace ament_index_cpp
