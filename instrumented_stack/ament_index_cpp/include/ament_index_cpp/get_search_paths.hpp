// SPDX-License-Identifier: Apache-2.0
// The folders in which the ament index is searched.
#pragma once

#include <list>
#include <string>

namespace ament_index_cpp {

// The existing directories of AMENT_PREFIX_PATH, in order. The last one is the prefix in which this library is
// installed, so its own packages are found without an environment. Unlike in ROS 2 an unset variable is no error.
std::list<std::string> get_search_paths();

}  // namespace ament_index_cpp
