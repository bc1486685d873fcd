// SPDX-License-Identifier: Apache-2.0
// Where the ament index is looked for.
#pragma once

#include <list>
#include <string>

namespace ament_index_cpp {

// The directories of AMENT_PREFIX_PATH that exist, in order, and last the prefix that this library is installed in: its
// own packages are found with no environment set up. Unlike in ROS 2 an unset variable is no error.
std::list<std::string> get_search_paths();

}  // namespace ament_index_cpp
